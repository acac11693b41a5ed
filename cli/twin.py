"""imitate twin: a real robot on this computer, to be used as if it stood in the lab."""

import threading
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from cli import trouble
from cli.build import Bench, Config
from cli.errors import DONE, UserError, no_such
from cli.experiments import composed
from cli.words import understand
from imitation.robots import servo_bus_emulator, ssc32_emulator
from imitation.robots.bullet.arm import BulletArm
from imitation.robots.faults import Fault, Faults, read_fault
from imitation.robots.katana import emulator as katana_emulator
from imitation.robots.katana.emulated_arm import EmulatedArm
from imitation.robots.katana.emulator import KatanaEmulator
from imitation.robots.katana.models import MODELS
from imitation.robots.mjpeg import MjpegServer
from imitation.robots.serving import Server
from imitation.robots.servo_bus_emulator import ServoBusEmulator
from imitation.robots.ssc32 import Servo
from imitation.robots.twin import CAMERA_FAULTS, Emulated, Twin

RATE, QUALITY = 25.0, 100  # of the camera: pictures per second [Hz], quality of its JPEGs
KATANA = "katana"
FAULTS = {KATANA: katana_emulator.FAULTS, "so101": servo_bus_emulator.FAULTS}
# How a Katana of each model is asked for.
TYPED = {"300": "katana_300", "400": KATANA, "450": f"{KATANA} robot.arm.model=450"}
# Commands that watch a demonstrator, each from its own gaze, and what they must be told.
WATCHING = {"demo-record": (), "mimic": ("map=given",), "replay": ("map=given", "action=given")}
WITH_OBJECT = ("demo-record", "replay")
NECK = "neck_"  # before the name of a fault of the neck
NECK_FAULTS = {NECK + name: told for name, told in ssc32_emulator.FAULTS.items()}


@dataclass(frozen=True)
class Asked:
    """What was typed."""

    words: Sequence[str]
    watching: str  # the command that watches a demonstrator
    model: str  # of a Katana
    port: int  # of its arm; one with a serial line has a pty
    arm_pty: Path
    pty: Path
    stream_port: int
    faults: Sequence[str]


def twin(asked: Asked) -> int:
    """Serve the twin until interrupted."""
    robot, words = _whose(asked.words)
    if asked.model not in MODELS:
        raise UserError(no_such("model", asked.model, list(MODELS)))
    planned = [read_fault(one, FAULTS[robot] | CAMERA_FAULTS | NECK_FAULTS) for one in asked.faults]
    cfg = _config(asked.watching, words)
    bench = Bench({**cfg, "neck": None})  # the simulated camera needs none
    servos = [Servo(**cfg["neck"][axis]) for axis in ("pan", "tilt")]
    board = ssc32_emulator.Ssc32Emulator(_of_neck(planned))
    emulator, arm = _arm(robot, asked, Faults(planned))
    neck = Server(board)
    neck.open_pty(asked.pty)
    stream = MjpegServer(asked.stream_port)
    typed = TYPED[asked.model] if robot == KATANA else robot
    _tell(f"robot={typed} robot.arm.address={arm.where}", stream.url, neck.where)
    threads = [threading.Thread(target=one.serve, daemon=True) for one in (arm, neck)]
    for thread in threads:
        thread.start()
    try:
        _twin(bench, emulator, board, servos, stream, Faults(planned)).run(over=lambda: False)
    finally:
        for server, thread in zip((arm, neck), threads, strict=True):
            server.stopped = True
            thread.join(timeout=1.0)
        stream.close()
        bench.robot.close()
    return DONE


def _whose(words: Sequence[str]) -> tuple[str, list[str]]:
    """Whose twin it is, and the words of its simulated world."""
    named = [word for word in words if word.startswith("robot=")]
    robot = named[-1].removeprefix("robot=").removesuffix("_sim") if named else KATANA
    if robot not in FAULTS:
        raise UserError(no_such("robot with a twin", robot, list(FAULTS)))
    return robot, [f"robot={robot}_sim", *(word for word in words if word not in named)]


def _arm(robot: str, asked: Asked, faults: Faults) -> tuple[Emulated, Server]:
    """The emulated arm, and where it is served."""
    emulator: KatanaEmulator | ServoBusEmulator = ServoBusEmulator(faults=faults)
    over_tcp = robot == KATANA and not MODELS[asked.model].serial
    if robot == KATANA:
        emulator = KatanaEmulator(EmulatedArm(MODELS[asked.model]), faults)
    server = Server(emulator)
    if over_tcp:
        server.listen(asked.port)
    else:
        server.open_pty(asked.arm_pty)
    return emulator, server


def _config(command: str, words: Sequence[str]) -> Config:
    """Of the simulated robot; a demonstrator's hand is in view when the words name one."""
    if command not in WATCHING:
        raise UserError(no_such("command that watches", command, list(WATCHING)))
    given = understand(list(words)).overrides
    typed = [*WATCHING[command], "demonstrator=none", "neck=ssc32"]
    if command in WITH_OBJECT and not any(
        "demonstrator=" in one or "object" in one for one in given
    ):
        typed.append("~object")  # nothing is in the way of an arm that is not shown anything
    try:
        return composed(command, *typed, *given)
    except Exception as error:
        raise trouble.as_user_error(command, error) from error


def _twin(
    bench: Bench,
    emulator: Emulated,
    board: ssc32_emulator.Ssc32Emulator,
    servos: Sequence[Servo],
    stream: MjpegServer,
    faults: Faults,
) -> Twin:
    body, camera = bench.robot.arm, bench.cfg["camera"]
    if not isinstance(body, BulletArm):
        raise UserError("the twin is made of PyBullet: leave robot.arm._target_ as it is")
    return Twin(
        arm=body,
        emulator=emulator,
        board=board,
        servos=servos,
        space=bench.learning_space,
        eye=np.array(camera["eye"], dtype=float),
        straight=np.array(camera["gaze"], dtype=float),
        demonstrator=bench.demonstrator,
        stream=stream,
        rate=RATE,
        quality=QUALITY,
        faults=faults,
    )


def _of_neck(planned: Sequence[Fault]) -> Faults:
    named = [one for one in planned if one.name.startswith(NECK)]
    return Faults([replace(one, name=one.name.removeprefix(NECK)) for one in named])


def _tell(arm: str, camera: str, neck: str) -> None:
    print("the twin is ready; Ctrl-C ends it. In another terminal type for instance")
    typed = f"imitate learn-map {arm} camera.device={camera} neck=ssc32 neck.port={neck}"
    print(typed, flush=True)
