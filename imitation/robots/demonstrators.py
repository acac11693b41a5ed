"""Demonstrators: whoever moves another hand before the simulated camera.

Their hand moves along a gesture given in visual space, so that it is known what should be seen of
it; in the world it moves on the plane in which the robot's own mark is while it holds something.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from imitation.arrays import Array
from imitation.gaze import VisualSpace
from imitation.robots.hand_paths import Gesture

Colour = tuple[float, float, float, float]  # red, green, blue, opacity [0..1]


@dataclass(frozen=True)
class Hand:
    """What a camera sees of a demonstrator's hand: a sphere."""

    radius: float  # [m]
    colour: Colour


@dataclass(frozen=True)
class Shown:
    """What a demonstrator shows at one time."""

    mark: Array | None  # centre of the mark on the hand, (3,) [m]; None: no hand in sight
    carrying: bool = False  # the object moves with the hand
    instead: bool = False  # it is seen in the place of the robot's own hand, as by a mirror


class Demonstrator(Protocol):
    """Who moves that other hand."""

    @property
    def hand(self) -> Hand:
        """How that hand looks."""

    def at(self, time: float) -> Shown:
        """What is shown `time` seconds after the episode began."""

    def place(self, time: float) -> Array | None:
        """Where the hand's mark truly is in visual space then, (2,) [px]; None: not shown."""


@dataclass(frozen=True)
class HandOverTable:
    """A demonstrator whose hand follows a gesture at one height over the table.

    Args:
        hand: How it looks.
        gesture: Its way in visual space.
        space: That visual space.
        eye: Optical centre of the camera, (3,) [m].
        height: Of the robot's own mark when its hand is where this one is [m].
        higher: The demonstrator's mark is this much higher than that [m].
    """

    hand: Hand
    gesture: Gesture
    space: VisualSpace
    eye: Array
    height: float
    higher: float

    def at(self, time: float) -> Shown:
        """What is shown `time` seconds after the episode began."""
        place = self.gesture.place(time)
        if place is None:
            return Shown(None, instead=self.gesture.instead(time))
        mark = self.space.unproject(place, self.eye, self.height)
        raised = mark + np.array((0.0, 0.0, self.higher))
        return Shown(raised, self.gesture.carries(time), self.gesture.instead(time))

    def place(self, time: float) -> Array | None:
        """Where the hand's mark truly is in visual space then, (2,) [px]; None: not shown."""
        mark = self.at(time).mark
        return None if mark is None else self.space.project(mark, self.eye)
