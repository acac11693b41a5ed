"""imitate emulate: a device on this computer that speaks its wire protocol."""

from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from cli.errors import DONE, UserError, no_such
from imitation.robots import servo_bus_emulator as servo_bus
from imitation.robots import ssc32_emulator as ssc32
from imitation.robots.emulated_servos import MAKES
from imitation.robots.faults import Faults, read_fault
from imitation.robots.katana.emulated_arm import EmulatedArm
from imitation.robots.katana.emulator import FAULTS, KatanaEmulator
from imitation.robots.katana.models import MODELS
from imitation.robots.serving import Device, Server

DEVICES = {"katana": FAULTS, "ssc32": ssc32.FAULTS, "servo-bus": servo_bus.FAULTS}
FASTEST = 1000.0  # times the real device: more than anybody needs, and far from an overflow


@dataclass(frozen=True)
class Asked:
    """What was typed after the device's name."""

    model: str | None
    port: int | None
    pty: Path | None
    faults: Sequence[str]
    speed: float


def emulate(device: str, asked: Asked) -> int:
    """Serve a device until interrupted."""
    server = Server(_device(device, asked))
    if (asked.port is None) == (asked.pty is None):
        raise UserError("give either --port NUMBER (TCP on 127.0.0.1) or --pty PATH (serial)")
    with closing(server):
        if asked.port is not None:
            server.listen(asked.port)
        elif asked.pty is not None:
            server.open_pty(asked.pty)
        print(f"{device} at {server.where}; Ctrl-C ends it", flush=True)
        server.serve()
    return DONE


def _device(name: str, asked: Asked) -> Device:
    if name not in DEVICES:
        raise UserError(no_such("device", name, list(DEVICES)))
    if not 0 < asked.speed <= FASTEST:
        raise UserError(f"--speed is a factor above 0, at most {FASTEST:g}, not {asked.speed:g}")
    if name == "ssc32" and asked.model is not None:
        raise UserError("an ssc32 comes in one model; leave out --model")
    models = MAKES if name == "servo-bus" else MODELS
    model = asked.model or ("sts3215" if name == "servo-bus" else "400")
    if model not in models:
        raise UserError(no_such("model", model, list(models)))
    faults = Faults([read_fault(one, DEVICES[name]) for one in asked.faults])
    if name == "ssc32":
        return ssc32.Ssc32Emulator(faults, asked.speed)
    if name == "servo-bus":
        return servo_bus.ServoBusEmulator(make=MAKES[model], faults=faults, speed=asked.speed)
    return KatanaEmulator(EmulatedArm(MODELS[model]), faults, asked.speed)
