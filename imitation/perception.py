"""From a frame to the hand's place in visual space and the activity of the visual neurons."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from imitation.arrays import Array
from imitation.gaze import VisualSpace
from imitation.robot import Observation
from imitation.visual_field import VisualField


class Detector(Protocol):
    """Tells the hand's pixels from all others."""

    def hand_in(self, seen: Observation) -> Array:
        """Centres of the hand's pixels, (n, 2) [px]; n = 0 when unseen."""


@dataclass(frozen=True)
class Percept:
    """What was seen at one step."""

    time_ns: int  # when the frame was captured
    hand: Array | None  # where the hand is seen, (2,) [px of visual space]; None: not seen
    visual_input: Array  # I, activity of the visual neurons, (rows, columns)


@dataclass(frozen=True)
class Perception:
    """Sees the hand: detector, then visual space, then visual field."""

    detector: Detector
    space: VisualSpace
    field: VisualField

    def perceive(self, observation: Observation) -> Percept:
        """What `observation`'s frame shows."""
        pixels = self.detector.hand_in(observation)
        places = self.space.to_visual_space(pixels, observation.frame_gaze)
        places = places[np.isfinite(places).all(axis=1)] + observation.place_noise
        hand = places.mean(axis=0) if len(places) else None
        return Percept(observation.frame_time_ns, hand, self.field.activity(places))
