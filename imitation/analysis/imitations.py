"""What one map's mimicry brought: paths, numbers, controls, the mirror."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from imitation.analysis.mirror import Aside
from imitation.arrays import Array
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass(frozen=True)
class Followed:
    """One gesture followed."""

    gesture: str
    selection: str
    period: float  # of the gesture [s]
    told: dict[str, Any]  # as in metrics.json
    shown: Array  # the demonstrated path, (n, 2) [px]
    own: Array  # the robot's, (n, 2) [px]


@dataclass(frozen=True)
class Smoothed:
    """What a time constant of the arm does."""

    selection: str
    tau: float  # [s]
    lag_s: float
    jitter_px: float


@dataclass(frozen=True)
class Imitations:
    """All that was run with one map."""

    learned: VisuoMotorMap
    transition_s: float  # the fastest way from a learned posture to the next, median
    followed: Sequence[Followed]
    smoothed: Sequence[Smoothed]
    correlation: float  # of the run that the shuffled maps are compared with
    shuffled: Array  # correlations with shuffled maps, (n,)
    travelled: dict[str, float]  # how far the arm went with nobody to imitate [px]
    mirror: Sequence[Aside]

    def of(self, selection: str, period: float) -> list[Followed]:
        """The gestures of this period followed by this selection."""
        return [one for one in self.followed if (one.selection, one.period) == (selection, period)]


def fastest_transition(learned: VisuoMotorMap, acceleration: Array) -> float:
    """Median over neighbouring learned areas of the least time from posture to posture [s].

    As long as the slowest joint takes that speeds up halfway and brakes the other half.
    """
    postures = learned.postures[:, :, 0]
    apart = [np.diff(postures, axis=axis).reshape(-1, postures.shape[-1]) for axis in (0, 1)]
    times = 2 * np.sqrt(np.abs(np.concatenate(apart)) / acceleration).max(axis=1)
    return float(np.nanmedian(times))
