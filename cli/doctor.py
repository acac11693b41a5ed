"""imitate doctor: does everything that a run needs work here? It moves no real arm."""

import json
import os
import shutil
import sys
import time
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.text import Text

import imitation
from cli import trouble
from cli.build import Config
from cli.config_dir import check_config_dir
from cli.device_check import device_findings
from cli.errors import DEVICE, DONE, NOT_TRUE
from cli.experiments import composed
from cli.findings import FAIL, Finding, Suspicious, look
from cli.printed import listing
from cli.words import quoted, understand
from imitation.gaze import VisualSpace

COLOURS = {"pass": "green", "warn": "yellow", "fail": "red"}
LEAST_ROOM = 2.0  # of the disk [GB]; an hour of a simulated arm takes about half of it
SLOWEST = 20.0  # of the disk [MB/s]
PACKAGES = ("numpy", "opencv-python-headless", "pybullet", "mcap", "rosbags", "rerun-sdk")


def doctor(words: Sequence[str], own: Path | None, as_json: bool) -> int:
    """Look at everything, tell what was found, and return the exit code.

    Args:
        words: KEY=VALUE, whose devices to look at.
        own: Folder with configurations of the user's own.
        as_json: Whether programs are to read it.
    """
    findings = list(_installation())
    overrides = understand(list(words)).overrides
    if overrides:
        findings += device_findings(_composed(overrides, own))
    if as_json:
        print(json.dumps([vars(one) for one in findings], indent=2))
    else:
        _show(findings)
    failed = [one for one in findings if one.verdict == FAIL]
    if not failed:
        return DONE
    return DEVICE if all(one.device for one in failed) else NOT_TRUE


def _composed(overrides: Sequence[str], own: Path | None) -> Config:
    places = []
    if own:
        check_config_dir(own)
        places = [quoted(f"file://{own.resolve()}")]
    try:
        return composed("learn-map", *overrides, own=tuple(places))
    except Exception as error:
        raise trouble.as_user_error("learn-map", error) from error


def _installation() -> Iterator[Finding]:
    yield look("python", _python)
    yield look("packages", lambda: ", ".join(f"{name} {version(name)}" for name in PACKAGES))
    yield look("renderer", _renderer)
    yield look("viewer", _viewer)
    yield look("disk", _disk)


def _python() -> str:
    ours = Path(imitation.__file__).parent
    if not (ours / "visuo_motor_map.py").is_file():
        raise OSError(f"the package imitation in {ours} is another project's; use .venv of make")
    if sys.version_info[:2] != (3, 11):
        raise OSError(f"this is Python {sys.version.split()[0]}, PyBullet's wheels need 3.11")
    return sys.version.split()[0]


def _renderer() -> str:
    from cli.build import Bench

    bench = Bench(composed("learn-map"))
    robot = bench.robot
    robot.reset()
    began, pictures = time.perf_counter(), 20
    for _ in range(pictures):
        frame = robot.camera.look(0, None).frame
    each = (time.perf_counter() - began) / pictures
    robot.close()
    if not np.ptp(frame):
        raise OSError("the simulated camera shows one colour: the renderer does not work")
    if each > bench.cfg["period"] / 2:
        raise Suspicious(f"a picture takes {1000 * each:.1f} ms: simulated runs will be slow")
    return f"PyBullet with numpy, {1000 * each:.1f} ms a picture of {_size(bench.space)}"


def _size(space: VisualSpace) -> str:
    width, height = space.size
    return f"{width}x{height}"


def _viewer() -> str:
    if sys.platform == "linux" and not {"DISPLAY", "WAYLAND_DISPLAY"} & set(os.environ):
        raise Suspicious("no screen: type imitate view RUN --screenshot FILE")
    return f"Rerun {version('rerun-sdk')}"


def _disk() -> str:
    folder = next(path for path in (Path("data/runs"), Path("data"), Path()) if path.is_dir())
    room = shutil.disk_usage(folder).free / 1e9
    trial, block = folder / ".doctor", os.urandom(1 << 20)
    began = time.perf_counter()
    try:
        with trial.open("wb") as file:
            for _ in range(8):
                file.write(block)
            file.flush()
            os.fsync(file.fileno())
    finally:
        trial.unlink(missing_ok=True)
    rate = 8 / (time.perf_counter() - began)
    told = f"{room:.0f} GB free, {rate:.0f} MB/s where runs are written"
    if room < LEAST_ROOM or rate < SLOWEST:
        raise Suspicious(f"{told}: recordings need {LEAST_ROOM:g} GB and {SLOWEST:g} MB/s")
    return told


def _show(findings: Sequence[Finding]) -> None:
    rows = [
        (Text(one.verdict, style=COLOURS[one.verdict]), one.subject, one.told) for one in findings
    ]
    table = listing("imitate doctor", ("", "looked at", "found"), rows)
    Console(highlight=False).print(table)
