"""imitate twin: the paper's robot on this computer, to be used as if it stood in the lab."""

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
from imitation.robots import ssc32_emulator
from imitation.robots.bullet.arm import BulletArm
from imitation.robots.faults import Fault, Faults, read_fault
from imitation.robots.katana.emulated_arm import EmulatedArm
from imitation.robots.katana.emulator import FAULTS, KatanaEmulator
from imitation.robots.katana.models import MODELS
from imitation.robots.mjpeg import MjpegServer
from imitation.robots.serving import Server
from imitation.robots.ssc32 import Servo
from imitation.robots.twin import CAMERA_FAULTS, Twin

RATE, QUALITY = 25.0, 100  # of the camera: pictures per second [Hz], quality of its JPEGs
# Commands that watch a demonstrator, each from its own gaze, and what they must be told.
WATCHING = {"demo-record": (), "mimic": ("map=given",), "replay": ("map=given", "action=given")}
NECK = "neck_"  # before the name of a fault of the neck
NECK_FAULTS = {NECK + name: told for name, told in ssc32_emulator.FAULTS.items()}


@dataclass(frozen=True)
class Asked:
    """What was typed."""

    words: Sequence[str]
    watching: str  # the command that watches a demonstrator
    model: str
    port: int
    pty: Path
    stream_port: int
    faults: Sequence[str]


def twin(asked: Asked) -> int:
    """Serve the twin until interrupted."""
    if asked.model not in MODELS or MODELS[asked.model].serial:
        raise UserError(no_such("model with TCP", asked.model, ["400", "450"]))
    planned = [read_fault(one, FAULTS | CAMERA_FAULTS | NECK_FAULTS) for one in asked.faults]
    cfg = _config(asked.watching, asked.words)
    bench = Bench({**cfg, "neck": None})  # the simulated camera needs none
    servos = [Servo(**cfg["neck"][axis]) for axis in ("pan", "tilt")]
    board = ssc32_emulator.Ssc32Emulator(_of_neck(planned))
    emulator = KatanaEmulator(EmulatedArm(MODELS[asked.model]), Faults(planned))
    servers = [Server(emulator), Server(board)]
    servers[0].listen(asked.port)
    servers[1].open_pty(asked.pty)
    stream = MjpegServer(asked.stream_port)
    _tell(servers, stream)
    threads = [threading.Thread(target=one.serve, daemon=True) for one in servers]
    for thread in threads:
        thread.start()
    try:
        _twin(bench, emulator, board, servos, stream, Faults(planned)).run(over=lambda: False)
    finally:
        for server, thread in zip(servers, threads, strict=True):
            server.stopped = True
            thread.join(timeout=1.0)
        stream.close()
        bench.robot.close()
    return DONE


def _config(command: str, words: Sequence[str]) -> Config:
    """Of the simulated robot; a demonstrator's hand is in view when the words name one."""
    if command not in WATCHING:
        raise UserError(no_such("command that watches", command, list(WATCHING)))
    typed = [*WATCHING[command], "demonstrator=none", "neck=ssc32"]
    try:
        return composed(command, *typed, *understand(list(words)).overrides)
    except Exception as error:
        raise trouble.as_user_error(command, error) from error


def _twin(
    bench: Bench,
    emulator: KatanaEmulator,
    board: ssc32_emulator.Ssc32Emulator,
    servos: Sequence[Servo],
    stream: MjpegServer,
    faults: Faults,
) -> Twin:
    body, camera = bench.robot.arm, bench.cfg["camera"]
    if not isinstance(body, BulletArm):
        raise UserError("the twin is made of PyBullet: leave robot= out, or type robot=katana_sim")
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


def _tell(servers: Sequence[Server], stream: MjpegServer) -> None:
    arm, neck = (server.where for server in servers)
    print("the twin is ready; Ctrl-C ends it. In another terminal type for instance")
    print(
        f"imitate learn-map robot=katana robot.arm.address={arm} camera.device={stream.url} "
        f"neck=ssc32 neck.port={neck}",
        flush=True,
    )
