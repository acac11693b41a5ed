"""learn-map guide=true: record the guided postures with the arm in the experimenter's hands."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from cli.errors import UserError
from imitation.arrays import Array
from imitation.robot import Arm, Limp

FEWEST = 3  # postures that span a field


def guide(arm: Arm, robot: str, ask: Callable[[str], str]) -> Array:
    """The postures that the arm was led to by hand, (n, n_joints) [rad].

    Args:
        arm: Made limp meanwhile, and stiff again whatever happens.
        robot: What `robot=` named, for the error.
        ask: Shows a sentence and returns what was typed.

    Raises:
        UserError: The arm cannot be made limp.
    """
    if not isinstance(arm, Limp):
        raise UserError(
            f"guide=true: robot={robot} cannot be made limp; write the postures into its YAML "
            "instead, as robot.guided='[[...],[...],[...]]' [rad]"
        )
    postures: list[Array] = []
    arm.go_limp()
    try:
        while True:
            number = len(postures) + 1
            typed = ask(
                f"lead the hand just above the table to place {number}, then press Enter"
                + (", or type done: " if number > FEWEST else ": ")
            )
            if typed.strip() == "done" and len(postures) >= FEWEST:
                return np.array(postures)
            postures.append(arm.read().posture)
    finally:
        arm.go_stiff()


def typed_answer(sentence: str) -> str:
    """What the person at the terminal types after `sentence`."""
    try:
        return input(sentence)
    except EOFError:
        raise UserError("guide=true needs a person at the terminal; leave it out here") from None


def write_guided(path: Path, postures: Array) -> None:
    """Write postures as a configuration that `--config-dir` can load."""
    rows = "".join(
        f"    - [{', '.join(f'{value:.4f}' for value in posture)}]\n" for posture in postures
    )
    path.write_text(
        "# @package _global_\n# Postures led to by hand [rad].\nrobot:\n  guided:\n" + rows
    )
