"""Gestures: the way of a demonstrator's hand through visual space over time."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from imitation.arrays import Array

Numbers = Sequence[float]


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


def line(centre: Numbers, size: Numbers, period: float, laps: int | None, start: float) -> Gesture:
    """From one corner of a box to the opposite one and back."""
    return Laps(_round_trip(_corners(centre, size)[::2]), period, laps, start)


def square(
    centre: Numbers, size: Numbers, period: float, laps: int | None, start: float
) -> Gesture:
    """Round a box, slowly at its corners, from the top left one to the top right one."""
    return Laps(_round_trip(_corners(centre, size)), period, laps, start)


def circle(
    centre: Numbers, size: Numbers, period: float, laps: int | None, start: float
) -> Gesture:
    """Round an ellipse, from its left end upwards."""

    def figure(share: float) -> Array:
        angle = 2 * np.pi * share
        return np.asarray(centre - np.array(size) / 2 * (np.cos(angle), np.sin(angle)))

    return Laps(figure, period, laps, start)


def figure_eight(
    centre: Numbers, size: Numbers, period: float, laps: int | None, start: float
) -> Gesture:
    """Two loops in a box, the upper one first, from its middle to the upper right."""

    def figure(share: float) -> Array:
        angle = 2 * np.pi * share
        return np.asarray(centre + np.array(size) / 2 * (np.sin(2 * angle), -np.sin(angle)))

    return Laps(figure, period, laps, start)


def waypoints(waypoints: Sequence[Numbers], stays: bool) -> Gesture:
    """Through `waypoints`, each a time [s] and a place x, y [px]."""
    table = np.array(waypoints, dtype=float)
    if np.any(np.diff(table[:, 0]) <= 0):
        raise ValueError(
            f"demonstrator.waypoints: times must ascend, got {table[:, 0].tolist()}; sort them"
        )
    return Waypoints(table[:, 0], table[:, 1:], stays)


def pick_and_place(
    places: Sequence[Numbers], rests: Numbers, travel: float, leaves_to: Numbers
) -> Gesture:
    """Wait, take the object, carry it by a place, let it go, leave.

    Args:
        places: The four places, (4, 2) [px].
        rests: How long the hand rests at each of them, (4,) [s].
        travel: From one to the next, and away [s].
        leaves_to: Where it goes at the end, to be seen no more, (2,) [px].
    """
    times = [0.0]
    for rest in rests:
        times += [times[-1] + rest, times[-1] + rest + travel]
    held = np.repeat(np.array(places, dtype=float), 2, axis=0)
    takes, lets_go = times[2], times[6]
    way = np.vstack((held, leaves_to))
    return Waypoints(np.array(times), way, stays=False, carried=(takes, lets_go))


def trigger(place: Numbers, at: float, stay: float | None) -> Gesture:
    """A hand that appears and is at rest; after `stay` seconds it is gone (None: it stays)."""
    times = np.array((at, at + (1.0 if stay is None else stay)))
    return Waypoints(times, np.array((place, place), dtype=float), stays=stay is None)


def mirror(
    ends: Sequence[Numbers],
    begins: float,
    lasts: float,
    switch: float,
    deviation: float,
    onset: float,
) -> Gesture:
    """Nielsen's mirror; see `Straight` and `Mirrored` for the values."""
    line = Straight(np.array(ends, dtype=float), begins, lasts)
    return Mirrored(line, switch, deviation, onset)


def nobody() -> None:
    """No demonstrator."""


def _corners(centre: Numbers, size: Numbers) -> Array:
    """Corners of a box, (4, 2) [px]: top left, top right, bottom right, bottom left."""
    signs = np.array(((-1, -1), (1, -1), (1, 1), (-1, 1)))
    return np.asarray(centre + signs * np.array(size) / 2)


def _round_trip(corners: Array) -> Callable[[float], Array]:
    """The figure that visits `corners` in turn, with a short rest at each."""
    way = Waypoints(np.linspace(0, 1, len(corners) + 1), np.vstack((corners, corners[:1])), True)
    return lambda share: np.asarray(way.place(share))
