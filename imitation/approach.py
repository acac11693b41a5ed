"""Leads a real arm to a posture, slowly and within the guard: to begin an episode, or to park."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from imitation.arrays import Array
from imitation.clock import SECOND, WallClock
from imitation.device import DeviceError
from imitation.dynamics import able_to_stop
from imitation.guard import Guard

if TYPE_CHECKING:
    from imitation.robot import Arm


@dataclass(frozen=True)
class Approach:
    """How a real arm is led to a posture.

    Args:
        share: Of the joints' largest speed, at most.
        tolerance: The arm is there when every joint is nearer than this [rad].
        patience: An arm that has got no nearer for so long is stuck [s].
        park: Whether it is led to where it rests at the end of a run too.
    """

    share: float
    tolerance: float
    patience: float
    park: bool


def lead(
    arm: "Arm", guard: Guard, target: Array, before: Array, period_ns: int, how: Approach
) -> None:
    """Lead `arm` to rest at `target` [rad].

    Args:
        arm: What is led.
        guard: Every step goes through it.
        target: (n_joints,) [rad].
        before: Velocity of the last period, (n_joints,) [rad/s].
        period_ns: Control period [ns].
        how: How fast, and for how long it may stand still.

    Raises:
        DeviceError: The guard does not let it get there, or the arm does not move.
    """
    clock, period = WallClock(period_ns), period_ns / SECOND
    clock.begin()
    # Planned ahead of what is sensed: a real arm senses itself late.
    planned = arm.read().posture
    best, waited = np.inf, 0.0
    while True:
        away = float(np.abs(target - arm.read().posture).max())
        if max(away, float(np.abs(before).max()) * period) <= how.tolerance:
            break
        best, waited = (away, 0.0) if away < best - how.tolerance / 10 else (best, waited + period)
        if waited > how.patience:
            raise DeviceError(
                f"the arm gets no nearer than {away:.2f} rad to where it is led: take it there "
                "by hand, or put away what is in its way"
            )
        to_go = target - planned
        wanted = able_to_stop(to_go / period, to_go, guard.acceleration, period)
        excess = float(np.max(np.abs(wanted) / (guard.speed * how.share)))
        limited, _ = guard.limit(wanted / max(excess, 1.0), before, planned, period)
        sent = arm.move(limited, None, period)
        planned, before = planned + sent * period, limited
        clock.tick()
    arm.move(np.zeros(len(target)), None, period)
