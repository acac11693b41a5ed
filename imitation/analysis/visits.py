"""Visits of a hand to areas, and which of another hand's visits they follow."""

from collections.abc import Sequence
from dataclasses import dataclass

from imitation.visual_field import Area


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
