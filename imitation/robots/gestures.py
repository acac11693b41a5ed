"""Gestures of a demonstrator's hand, made of plain values; `_target_` in conf/ names them."""

from collections.abc import Callable, Sequence

import numpy as np

from imitation.arrays import Array
from imitation.robots.hand_paths import Gesture, Laps, Mirrored, Straight, Waypoints

Numbers = Sequence[float]


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
