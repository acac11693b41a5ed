"""Reaches as the figures show them: where the hand was seen, how far from the target, when."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from imitation.arrays import Array
from imitation.sample import Sample
from imitation.visual_field import Area
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass
class ReachedTrial:
    """One reach, step by step."""

    limit: float  # when the trial would have ended without success [s]
    times: list[float] = field(default_factory=list)  # since its start [s]
    hands: list[Array] = field(default_factory=list)  # where the hand was seen, (2,); nan: not [px]
    distances: list[float] = field(default_factory=list)  # to the target; nan: not seen [px]
    reached_s: float | None = None  # first seen within the tolerance [s]
    held_s: float | None = None  # beginning of the hold [s]
    held: bool = False
    _began: float = 0.0
    _settled_s: float | None = None

    def add(self, sample: Sample) -> None:
        """Note one more step."""
        if not self.times:
            self._began = sample.seen.time
        now = round(sample.seen.time - self._began, 9)
        seen = sample.percept.hand
        self.times.append(now)
        self.hands.append(np.full(2, np.nan) if seen is None else seen)
        self.distances.append(sample.decision.distance)
        for event in sample.events:
            if event.kind == "reached":
                self.reached_s = now
            if event.kind == "settled":
                self._settled_s = now
            if event.kind == "held":
                self.held, self.held_s = True, self._settled_s

    @property
    def path(self) -> Array:
        """Where the hand was seen, (n, 2) [px]."""
        return np.array(self.hands)

    @property
    def steps_until_reached(self) -> int:
        """How many steps it took to reach the target, the last one included; all, if it did not."""
        if self.reached_s is None:
            return len(self.times)
        return self.times.index(self.reached_s) + 1

    @property
    def stopped_px(self) -> float:
        """Distance at which the movement was stopped, or the last one seen [px]."""
        if self.reached_s is None:
            return self.final_px
        return self.distances[self.times.index(self.reached_s)]

    @property
    def time_s(self) -> float:
        """Until the target was reached, or the limit when it never was [s]."""
        return self.limit if self.reached_s is None else self.reached_s

    @property
    def time_to_hold_s(self) -> float:
        """Until the hold began, or the limit when there was none [s]."""
        return self.limit if self.held_s is None else self.held_s

    @property
    def final_px(self) -> float:
        """Distance to the target when the hand was seen last [px]."""
        seen = [distance for distance in self.distances if np.isfinite(distance)]
        return seen[-1] if seen else float("nan")


@dataclass(frozen=True)
class Situation:
    """A target on a map, and the attractors that take part there."""

    target: Array  # (2,) [px]
    active: tuple[Area, ...]  # learned areas that take part
    places: Array  # where the hand was seen for each of them in learning, (n, 2) [px]

    @cached_property
    def distances(self) -> Array:
        """From the target to those places, (n,) [px]."""
        return np.asarray(np.linalg.norm(self.places - self.target, axis=1))


@dataclass(frozen=True)
class Reaches:
    """Trials that reach for one target."""

    situation: Situation
    trials: tuple[ReachedTrial, ...]


@dataclass(frozen=True)
class MapReaches:
    """All reaches with one map."""

    learned: VisuoMotorMap
    at_learned: tuple[Reaches, ...]  # targets that are learned positions
    between: Reaches | None  # a target between four of them; None: the map has no such place
    others: dict[str, Reaches]  # the same target by the other controllers, by their names


def situation(learned: VisuoMotorMap, target: Array, radius: float) -> Situation:
    """What takes part at `target` (2,) [px]: learned areas centred nearer than `radius` [px]."""
    areas = np.argwhere((learned.field.within(target, radius) > 0) & learned.learned)
    active = tuple((int(row), int(column)) for row, column in areas)
    return Situation(target, active, np.array([place_of(learned, area) for area in active]))


def place_of(learned: VisuoMotorMap, area: Area) -> Array:
    """Where the hand was seen for a learned area's first posture, (2,) [px]."""
    holding = np.flatnonzero(learned.holds[area])
    return np.asarray(learned.places[(*area, holding[0])])


def learned_positions(learned: VisuoMotorMap, radius: float, active: int) -> list[Situation]:
    """Learned places at which `active` attractors take part."""
    areas = np.argwhere(learned.learned)
    places = [place_of(learned, (int(row), int(column))) for row, column in areas]
    found = [situation(learned, place, radius) for place in places]
    return [one for one in found if len(one.active) == active]


def between_four(learned: VisuoMotorMap, radius: float, average: float) -> Situation | None:
    """The corner of four areas where all take part, `average` px or nearly so from their places.

    Args:
        learned: The map.
        radius: Attractors of areas centred nearer than this take part [px].
        average: Mean distance to the four learned places that is wished for [px].

    Returns:
        None when no corner has four learned areas around it.
    """
    x_edges, y_edges = learned.field.edges
    corners = [np.array((x, y)) for x in x_edges[1:-1] for y in y_edges[1:-1]]
    found = [situation(learned, corner, radius) for corner in corners]
    among = [one for one in found if len(one.active) == 4]
    return min(among, key=lambda one: abs(one.distances.mean() - average), default=None)


def typical_of(reaches: Sequence[Reaches]) -> Reaches | None:
    """The reaches that take the median time; None of none."""
    times = [sum(trial.time_s for trial in one.trials) for one in reaches]
    order = np.argsort(times, kind="stable")
    return reaches[int(order[(len(times) - 1) // 2])] if reaches else None


def typical(runs: Sequence[MapReaches]) -> MapReaches | None:
    """The map whose reaches to the place between four take the median time.

    Maps with learned positions to reach for go first.
    """
    whole = [run for run in runs if run.between and run.at_learned]
    among = whole or [run for run in runs if run.between]
    times = [
        np.median([trial.time_s for trial in run.between.trials]) for run in among if run.between
    ]
    return among[int(np.argsort(times, kind="stable")[(len(times) - 1) // 2])] if among else None
