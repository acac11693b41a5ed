"""Emulated devices at the other end of a real line, served by a thread while a test lasts."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from imitation.robots.faults import Faults, read_fault
from imitation.robots.katana.driver import Katana, connect
from imitation.robots.katana.emulated_arm import EmulatedArm
from imitation.robots.katana.emulator import FAULTS, KatanaEmulator
from imitation.robots.katana.models import MODELS
from imitation.robots.serving import Device, Server

SPEED = 50.0  # times faster than a real device
TIMEOUT = 0.15  # for a reply; four of them outlast the late one of an emulator [s]


@contextmanager
def served(device: Device, pty: Path | None = None) -> Iterator[str]:
    """Where the device is found while it is served."""
    server = Server(device)
    if pty is None:
        server.listen(0)
    else:
        server.open_pty(pty)
    thread = threading.Thread(target=server.serve, daemon=True)
    thread.start()
    try:
        yield server.where
    finally:
        server.stopped = True
        thread.join(timeout=5)


def katana_device(model: str, *faults: str, speed: float = SPEED) -> KatanaEmulator:
    """An emulated Katana with these faults."""
    planned = [read_fault(one, FAULTS) for one in faults]
    return KatanaEmulator(EmulatedArm(MODELS[model]), Faults(planned), speed)


@contextmanager
def driven(device: KatanaEmulator, folder: Path) -> Iterator[Katana]:
    """A driver that talks to the emulated arm as to a real one: TCP, or a serial port."""
    model = device.arm.model
    with served(device, folder / "port" if model.serial else None) as where:
        arm = Katana(connect(model, where, TIMEOUT, tries=4), model)
        try:
            yield arm
        finally:
            arm.close()
