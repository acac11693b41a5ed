"""Paths of a demonstrator's hand through visual space over time, and when it carries something."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from imitation.arrays import Array


class Gesture(Protocol):
    """Where a hand is shown, and when it carries something."""

    def place(self, time: float) -> Array | None:
        """Where it is `time` seconds after the episode began, (2,) [px]; None: out of sight."""

    def carries(self, time: float) -> bool:
        """Whether it carries something then."""

    def instead(self, time: float) -> bool:
        """Whether it is seen in the place of the robot's own hand then."""


@dataclass(frozen=True)
class Beside:
    """What most gestures are: beside the robot's own hand, with nothing in the hand."""

    def carries(self, time: float) -> bool:
        """It never does."""
        return False

    def instead(self, time: float) -> bool:
        """It never is."""
        return False


@dataclass(frozen=True)
class Laps(Beside):
    """The same figure again and again.

    Args:
        figure: Place (2,) [px] after a share [0..1] of a lap.
        period: A lap lasts this long [s].
        laps: After so many the hand stays where it is; None: it never ends.
        start: The hand is shown at rest this long before it begins [s].
    """

    figure: Callable[[float], Array]
    period: float
    laps: int | None
    start: float

    def place(self, time: float) -> Array | None:
        """Where it is, (2,) [px]."""
        done = max(time - self.start, 0.0) / self.period
        return self.figure(1.0 if self.laps is not None and done >= self.laps else done % 1.0)


@dataclass(frozen=True)
class Waypoints(Beside):
    """From one place to the next, each left and entered smoothly; the same place twice is a rest.

    Args:
        times: When the hand is at each place, ascending, (n,) [s]; before the first it is not seen.
        places: (n, 2) [px].
        stays: Whether it is still seen after the last.
        carried: From when to when it carries something [s].
    """

    times: Array
    places: Array
    stays: bool
    carried: tuple[float, float] = (np.inf, np.inf)

    def place(self, time: float) -> Array | None:
        """Where it is, (2,) [px]; None: out of sight."""
        if time < self.times[0] or (time > self.times[-1] and not self.stays):
            return None
        after = int(np.searchsorted(self.times, time, side="right"))
        if after == len(self.times):
            return np.asarray(self.places[-1])
        (left, reached), (come_from, go_to) = (
            pair[after - 1 : after + 1] for pair in (self.times, self.places)
        )
        return np.asarray(come_from + eased((time - left) / (reached - left)) * (go_to - come_from))

    def carries(self, time: float) -> bool:
        """Whether it carries something then."""
        return self.carried[0] <= time < self.carried[1]


@dataclass(frozen=True)
class Straight:
    """Along a straight line at an even pace.

    Args:
        ends: Where it begins and where it ends, (2, 2) [px].
        begins: When it begins; until then it is at its beginning [s].
        lasts: How long it takes [s].
    """

    ends: Array
    begins: float
    lasts: float

    @property
    def aside(self) -> Array:
        """To the right of whoever goes along it, (2,), of length 1."""
        x, y = self.ends[1] - self.ends[0]
        return np.asarray(np.array((-y, x)) / np.hypot(x, y))

    def at(self, time: float) -> Array:
        """Where it is, (2,) [px]."""
        share = min(max((time - self.begins) / self.lasts, 0.0), 1.0)
        return np.asarray(self.ends[0] + share * (self.ends[1] - self.ends[0]))


@dataclass(frozen=True)
class Mirrored(Beside):
    """A hand that from some moment on is seen in the place of the robot's own, a little aside.

    Args:
        line: What the robot draws.
        switch: When the mirror turns [s].
        deviation: To the right of the line [px].
        onset: It comes to deviate so far within this time [s].
    """

    line: Straight
    switch: float
    deviation: float
    onset: float

    def place(self, time: float) -> Array | None:
        """Where it is, (2,) [px]; None until the mirror turns."""
        if not self.instead(time):
            return None
        grown = min((time - self.switch) / self.onset, 1.0)
        return self.line.at(time) + grown * self.deviation * self.line.aside

    def instead(self, time: float) -> bool:
        """Whether the mirror has turned."""
        return time >= self.switch


def eased(share: float) -> float:
    """How far a movement is after a `share` of its time, both [0..1]: at rest at both ends."""
    return float(1 - np.cos(np.pi * share)) / 2
