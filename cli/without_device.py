"""What to type when a device is not there: how to look at it, and how to do without."""

import shlex
from collections.abc import Sequence

from cli.following import OWN
from cli.keys import groups

DEVICES = (OWN, "robot", "camera", "neck")  # words that name one


def instead(robot: str, typed: Sequence[str]) -> str:
    """How to look at the devices that the words `typed` name, and what needs none."""
    named = [word for word in typed if word.startswith(DEVICES)]
    look = f"to look at it type {shlex.join(['imitate', 'doctor', *named])}"
    simulated = f"{robot}_sim"
    if simulated not in groups()["robot"]:
        return look
    twin = "imitate twin" if robot == "katana" else f"imitate twin robot={robot}"
    return f"{look}; robot={simulated} and {twin} need no device"
