"""Which command follows a run, so that it can be typed as it stands."""

import os
import shlex
from collections.abc import Sequence
from pathlib import Path

from imitation.recording.yaml_reading import read_yaml

OWN = "--config-dir="  # where the user's own arms are found
BODY = (OWN, "robot=", "robot.", "neck=", "neck.", "period=")  # words that choose the arm
CAMERA = ("camera",)
SIGHT = (*CAMERA, "vision")  # words that choose what is seen
FIRST_MAP = "data/runs/map"


def reach_with(run: str, typed: Sequence[str]) -> str:
    """To reach with the map of a run that was told the words `typed`."""
    return _command("reach", f"map={run}", *_chosen(typed, BODY + SIGHT))


def camera_words(typed: Sequence[str]) -> list[str]:
    """Those of the words `typed` that choose the camera."""
    return [word for word in typed if word.startswith(CAMERA)]


def replay_of(run: str, robot: str, typed: Sequence[str], watching_itself: Sequence[str]) -> str:
    """To replay the action of a run, with a map of the same robot: one must be learned at first.

    Args:
        run: Its folder.
        robot: Its robot's name.
        typed: What it was told.
        watching_itself: Words of that for the camera in which the arm sees its own hand.
    """
    body, sight = _chosen(typed, BODY), _chosen(typed, SIGHT)
    known = newest_map(robot)
    replay = _command("replay", f"map={known or FIRST_MAP}", f"action={run}", *body, *sight)
    if known:
        return replay
    words = [*body, *map(shlex.quote, watching_itself)]
    return f"{_command('learn-map', f'out={FIRST_MAP}', *words)} && {replay}"


def newest_map(robot: str) -> str | None:
    """Folder of the newest map of a robot in data/runs; None: there is none."""
    runs = Path("data/runs")
    found = (path for depth in ("*", "*/*", "*/*/*") for path in runs.glob(f"{depth}/map.npz"))
    maps = [path for path in found if path.is_file()]
    for path in sorted(maps, key=lambda one: one.stat().st_mtime, reverse=True):
        if _robot_of(path.with_name("config.yaml")) == robot:
            return shlex.quote(os.fspath(path.parent))
    return None


def _robot_of(config: Path) -> str | None:
    """Name of the robot of a run; None: its configuration cannot be read."""
    try:
        return str(read_yaml(config.read_bytes())["robot"]["name"])
    except (OSError, LookupError, TypeError, ValueError):
        return None


def _chosen(typed: Sequence[str], words: tuple[str, ...]) -> list[str]:
    return [shlex.quote(word) for word in typed if word.startswith(words)]


def _command(name: str, *words: str) -> str:
    return " ".join(["imitate", name, *words])
