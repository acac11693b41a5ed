"""Before a real arm moves for the first time: what is going to happen, and whether it may."""

import sys

import numpy as np
from rich.console import Console
from rich.table import Table

from cli.build import Bench
from cli.errors import UserError
from cli.printed import listing


def confirm_motion(bench: Bench) -> None:
    """Show what a real arm is about to do, and go on only when a person or --yes says so.

    Raises:
        UserError: Nobody said so.
    """
    cfg, arm = bench.cfg, bench.robot.arm
    if not arm.live or cfg["dry_run"]:
        return
    console = Console(stderr=True, highlight=False)
    console.print(_plan(bench))
    if cfg["confirmed"]:
        return
    if not sys.stdin.isatty():
        raise UserError("a real arm would move: type --yes to let it, or --dry-run to only look on")
    console.print("Keep clear of the arm, and its power switch at hand. Move? \\[y/N] ", end="")
    if input().strip().lower() not in ("y", "yes"):
        raise UserError("the arm was not moved")


def _plan(bench: Bench) -> Table:
    cfg, robot = bench.cfg, bench.robot
    here, home = robot.arm.read().posture, robot.home
    driving = cfg["robot"]["arm"].get("driving", {})
    degrees = np.degrees((here, home, robot.body.speed)).T
    table = listing(
        f"{robot.body.name} is about to move",
        ("joint", "is at", "goes to", "at most"),
        [
            (name, f"{at:.0f}°", f"{to:.0f}°", f"{speed:.0f}°/s")
            for name, (at, to, speed) in zip(robot.body.joint_names, degrees, strict=True)
        ],
    )
    notes = [f"period {robot.period:g} s", f"camera {cfg['camera'].get('device', 'simulated')}"]
    if driving.get("calibrate"):
        notes.append("FIRST IT SEARCHES ALL ITS STOPS (robot.arm.driving.calibrate=true)")
    if driving.get("unblock"):
        notes.append("crash flags are cleared first (robot.arm.driving.unblock=true)")
    table.caption = "; ".join(notes)
    return table
