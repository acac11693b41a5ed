"""From a frame to the hand's place in visual space and the activity of the visual neurons."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from imitation.arrays import Array, Mask
from imitation.gaze import VisualSpace
from imitation.robot import Observation
from imitation.visual_field import VisualField, most_active


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
    places: Array  # where what is seen in each area lies, (rows, columns, 2) [px]; nan: nothing is
    pixels: Array  # where all that looks like a hand is seen, own or other's, (n, 2) [px]


@dataclass(frozen=True)
class Perception:
    """Sees the hand: detector, then visual space, then visual field."""

    detector: Detector
    space: VisualSpace
    field: VisualField

    def perceive(self, observation: Observation, attended: Mask | None = None) -> Percept:
        """What `observation`'s frame shows.

        Args:
            observation: What the robot senses.
            attended: Areas that a hand counts in, (rows, columns): of two hands only one may be
                of interest. None: around the area that shows most, because between two hands
                there is none. The visual input is that of the whole image anyway.
        """
        pixels = self.detector.hand_in(observation)
        places = self.space.to_visual_space(pixels, observation.frame_gaze)
        places = places[np.isfinite(places[:, 0])] + observation.place_noise
        activity, means = self.field.activity(places), self.field.mean_places(places)
        if attended is None:
            counting = places[~self.field.inside(~self.field.around(most_active(activity)), places)]
        else:
            counting = places[self.field.inside(attended, places)]
        hand = counting.sum(axis=0) / len(counting) if len(counting) else None
        return Percept(observation.frame_time_ns, hand, activity, means, places)
