"""What replays came to where the demonstrator's mark is higher than the robot's own tag is."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from cli.deferred_runs import demonstrated, replayed
from imitation.analysis.deferred import PLACED
from imitation.visuo_motor_map import VisuoMotorMap


def replay_one(task: tuple[int, VisuoMotorMap, float, Sequence[str]]) -> dict[str, Any]:
    """Watch with one seed an action shown so much higher [m], and replay it."""
    seed, learned, higher, words = task
    raised = f"demonstrator.raise={higher}"
    return replayed(seed, learned, demonstrated(seed, raised), raised, *words).result()


def told_of_replays(name: str, higher: float, runs: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """One row of the table of deferred imitation."""
    errors = [run["object_error_m"] for run in runs if run["object_error_m"] is not None]
    timing = np.abs([one for run in runs for one in run["timing_error_s"]])
    return {
        "condition": name,
        "mark higher by [cm]": 100 * higher,
        "order correct": f"{sum(bool(run['order_correct']) for run in runs)} of {len(runs)}",
        "grasped": sum(bool(run["grasped"]) for run in runs),
        f"within {100 * PLACED:g} cm of the goal": sum(error <= PLACED for error in errors),
        "farthest from it [cm]": 100 * max(errors, default=float("nan")),
        "timing error median [s]": float(np.median(timing)) if len(timing) else None,
        "timing error largest [s]": float(timing.max()) if len(timing) else None,
    }
