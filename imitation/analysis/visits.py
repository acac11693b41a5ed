"""Visits of a hand to areas: which of another hand's they follow, and in which order."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.visual_field import Area, VisualField

PASSING = 0.3  # another learned state may be crossed for this long on the way [s]


@dataclass(frozen=True)
class Visit:
    """A stay in one area, or at its learned place."""

    area: Area
    begin: float  # [s]
    end: float  # [s]


def visits(times: Sequence[float], areas: Sequence[Area | None], period: float) -> list[Visit]:
    """The stays in one area after the other; a stay ends a period after its last sample [s]."""
    found: list[Visit] = []
    for time, area in zip(times, areas, strict=True):
        last = found[-1] if found else None
        if area is None:
            continue
        if last and last.area == area and time - last.end < period / 2:
            found[-1] = Visit(area, last.begin, time + period)
        else:
            found.append(Visit(area, time, time + period))
    return found


def followed_visits(shown: Sequence[Visit], own: Sequence[Visit], grace: float) -> list[Visit]:
    """Those of `shown` during which, or `grace` seconds after, an own visit to that area is made.

    In order, each own visit used once.
    """
    followed, first = [], 0
    for one in shown:
        for number in range(first, len(own)):
            visit = own[number]
            meets = visit.begin <= one.end + grace and visit.end > one.begin
            if visit.area == one.area and meets:
                followed.append(one)
                first = number + 1
                break
    return followed


@dataclass(frozen=True)
class Order:
    """How a path went through the areas of an action."""

    entries: tuple[float, ...]  # when the states in order were entered [s]
    correct: bool  # all of them, and no other in between for long


def visits_of(
    times: Sequence[float], hands: Sequence[Array], areas: Iterable[Area], field: VisualField
) -> list[Visit]:
    """Stays of a hand (n, 2) [px], seen at `times` [s], in any of `areas`."""
    of_interest, found = set(areas), list[Visit]()
    before: Area | None = None
    for time, hand in zip(times, hands, strict=True):
        area = field.area_of(hand) if np.isfinite(hand).all() else None
        if area in of_interest and area is not None:
            begin = found[-1].begin if area == before else time
            if area == before:
                found.pop()
            found.append(Visit(area, begin, time))
        before = area
    return found


def in_order(visits: Sequence[Visit], expected: Sequence[Area]) -> Order:
    """Whether `visits` go through `expected` in order, no other state between for long."""
    entries: list[float] = []
    correct = True
    for visit in visits:
        reached = len(entries)
        if reached < len(expected) and visit.area == expected[reached]:
            entries.append(visit.begin)
        elif reached and visit.area == expected[reached - 1]:
            continue
        elif visit.end - visit.begin > PASSING:
            correct = False
    return Order(tuple(entries), correct and len(entries) == len(expected))
