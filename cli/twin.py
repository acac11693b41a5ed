"""imitate twin: a real robot on this computer, to be used as if it stood in the lab."""

import threading
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
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
from imitation.robots.katana.models import MODELS, Model
from imitation.robots.mjpeg import MjpegServer
from imitation.robots.serving import Server
from imitation.robots.servo_bus_emulator import ServoBusEmulator
from imitation.robots.ssc32 import Servo
from imitation.robots.twin import CAMERA_FAULTS, Emulated, Twin

RATE, QUALITY = 25.0, 100  # of the camera: pictures per second [Hz], quality of its JPEGs
KATANA, USUAL = "katana", "400"  # and its model when none is given
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
    model: str | None  # of a Katana
    port: int  # of its arm; one with a serial line has a pty
    arm_pty: Path
    pty: Path
    stream_port: int
    faults: Sequence[str]


def twin(asked: Asked) -> int:
    """Serve the twin until interrupted."""
    robot, words = _whose(asked.words)
    katana = _katana(robot, asked.model)
    planned = [read_fault(one, FAULTS[robot] | CAMERA_FAULTS | NECK_FAULTS) for one in asked.faults]
    cfg = _config(asked.watching, words)
    bench = Bench({**cfg, "neck": None})  # the simulated camera needs none
    servos = [Servo(**cfg["neck"][axis]) for axis in ("pan", "tilt")]
    board = ssc32_emulator.Ssc32Emulator(_of_neck(planned))
    emulator = _emulator(katana, Faults(planned))
    arm, neck = Server(emulator), Server(board)
    typed = TYPED[katana.name] if katana else robot
    over_tcp = katana is not None and not katana.serial
    with _opened(arm, neck, asked, over_tcp) as stream:
        world = _twin(bench, emulator, board, servos, stream, Faults(planned))
        with closing(bench.robot), _served(arm, neck):
            _tell(f"robot={typed} robot.arm.address={arm.where}", stream.url, neck.where)
            world.run(over=lambda: False)
    return DONE


def _whose(words: Sequence[str]) -> tuple[str, list[str]]:
    """Whose twin it is, and the words of its simulated world."""
    named = [word for word in words if word.startswith("robot=")]
    robot = named[-1].removeprefix("robot=").removesuffix("_sim") if named else KATANA
    if robot not in FAULTS:
        raise UserError(no_such("robot with a twin", robot, list(FAULTS)))
    return robot, [f"robot={robot}_sim", *(word for word in words if word not in named)]


def _katana(robot: str, model: str | None) -> Model | None:
    """The Katana it is; None: another robot."""
    if robot == KATANA:
        name = USUAL if model is None else model
        if name not in MODELS:
            raise UserError(no_such("model", name, list(MODELS)))
        return MODELS[name]
    if model is not None:
        raise UserError(f"--model is of a Katana, not of robot={robot}; leave it out")
    return None


def _emulator(katana: Model | None, faults: Faults) -> KatanaEmulator | ServoBusEmulator:
    if katana:
        return KatanaEmulator(EmulatedArm(katana), faults)
    return ServoBusEmulator(faults=faults)


def _place(path: Path) -> Path:
    return path.parent.resolve() / path.name


@contextmanager
def _opened(arm: Server, neck: Server, asked: Asked, over_tcp: bool) -> Iterator[MjpegServer]:
    """The camera's stream, once all ports are open; they are closed in the end."""
    if not over_tcp and _place(asked.arm_pty) == _place(asked.pty):
        raise UserError(f"arm and neck are both at {asked.pty}; give --pty another path")
    with ExitStack() as opened:
        stream = opened.enter_context(closing(MjpegServer(asked.stream_port)))
        for server in (arm, neck):
            opened.callback(server.close)
        # What may be taken comes first: a twin that is refused leaves no link behind.
        if over_tcp:
            arm.listen(asked.port)
        else:
            arm.open_pty(asked.arm_pty)
        neck.open_pty(asked.pty)
        yield stream


@contextmanager
def _served(*servers: Server) -> Iterator[None]:
    """Meanwhile the servers serve."""
    threads = [threading.Thread(target=one.serve, daemon=True) for one in servers]
    for thread in threads:
        thread.start()
    try:
        yield
    finally:
        for server, thread in zip(servers, threads, strict=True):
            server.stopped = True
            thread.join(timeout=1.0)


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
