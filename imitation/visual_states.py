"""From what is seen of a hand to visual states: where it rests, in which area, since when (IV)."""

from dataclasses import dataclass

from imitation.arrays import Array
from imitation.visual_field import Area


@dataclass(frozen=True)
class VisualState:
    """An area in which the hand rested."""

    area: Area
    place: Array  # where the hand was seen resting, (2,) [px of visual space]
    time: float  # when the area began to win [s]
