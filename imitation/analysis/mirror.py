"""Nielsen's mirror in numbers: how far aside the own hand goes when another's deviates."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array


@dataclass(frozen=True)
class Aside:
    """What one deviation of the other's hand did, both to the same side if of the same sign."""

    deviation_px: float  # of the hand that is seen, from the line
    drawn_px: float  # of the arm that draws the line, from where it was before
    followed_px: float  # of the arm that keeps vision and posture in agreement, from the line


def aside(times: Array, places: Array, to_the_side: Array, at: float, window: float) -> float:
    """How far `places` (n, 2) [px] lie `to_the_side` (2,) in the mean about a time `at` [s]."""
    about = np.abs(times - at) <= window / 2
    return float((places[about] @ to_the_side).mean())


def corrects_against(found: Sequence[Aside]) -> bool:
    """Whether the drawing arm goes to the other side than any hand that deviates."""
    return all(one.drawn_px < 0 for one in found if one.deviation_px > 0)


def follows(found: Sequence[Aside]) -> bool:
    """Whether the other arm goes to the same side as any hand that deviates."""
    return all(one.followed_px > 0 for one in found if one.deviation_px > 0)


def grows(found: Sequence[Aside]) -> bool:
    """Whether a larger deviation moves the drawing arm farther aside."""
    in_order = sorted(found, key=lambda one: one.deviation_px)
    return bool(np.all(np.diff([abs(one.drawn_px) for one in in_order]) > 0))
