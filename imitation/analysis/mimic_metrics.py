"""From the samples of a mimic run to the numbers of `metrics.json`."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from imitation.analysis.mimicry import (
    correlation,
    dtw,
    frechet,
    jitter,
    lag_steps,
    lag_taken_out,
    rmse,
)
from imitation.analysis.place_prediction import place_shown_at
from imitation.analysis.visits import Visit, followed_visits, visits
from imitation.arrays import Array
from imitation.robot import Truth
from imitation.sample import Sample
from imitation.visual_field import Area
from imitation.visuo_motor_map import VisuoMotorMap

UNSEEN = np.full(2, np.nan)


@dataclass(frozen=True)
class Judging:
    """How a mimic run is measured; its YAML says what each means."""

    catching_up: float
    largest_lag: float
    shortest: float
    grace: float
    near: float
    jitter_hz: Sequence[float]
    frechet_points: int


@dataclass
class MimicMetrics:
    """Follows a mimic run, sample by sample.

    Args:
        learned: The map in use.
        demonstrated: Where the demonstrator's hand truly is after a time [s], (2,) [px]; None:
            there is only what was seen.
        in_area: An area is followed by being in it; otherwise by being near its learned place.
        period: Control period [s].
        judging: How it is measured.
    """

    learned: VisuoMotorMap
    demonstrated: Callable[[float], Array | None] | None
    in_area: bool
    period: float
    judging: Judging
    times: list[float] = field(default_factory=list)  # since the start [s]
    shown: list[Array] = field(default_factory=list)  # the demonstrated path, (2,) each [px]
    own: list[Array] = field(default_factory=list)  # the robot's path, (2,) each [px]
    _truths: dict[int, Array] = field(default_factory=dict)
    _from_truth: bool = False
    _seen: bool = False
    _begun: float | None = None

    def add(self, sample: Sample, truths: Iterable[Truth]) -> None:
        """Note one step and what was true around it."""
        for truth in truths:
            self._truths[truth.time_ns] = truth.hand_px
        if self._begun is None:
            self._begun = sample.seen.time
        now = round(sample.seen.time - self._begun, 9)
        # Before the neck has turned, the own hand is seen beside the visual field.
        seen = sample.percept.hand if sample.percept.visual_input.any() else None
        self._seen |= seen is not None
        shown = self.demonstrated(now) if self.demonstrated else seen
        own = self._truths.pop(sample.seen.time_ns, None)
        self._from_truth |= own is not None
        self.times.append(now)
        self.shown.append(UNSEEN if shown is None else shown)
        self.own.append(place_shown_at(self.learned, sample.seen.posture) if own is None else own)

    @property
    def ever_seen(self) -> bool:
        """Whether a hand was ever seen in the visual field."""
        return self._seen

    def paths(self) -> tuple[Array, Array]:
        """The demonstrated path and the robot's, (n, 2) each [px], once it had time to catch up."""
        caught_up = np.array(self.times) >= self.judging.catching_up
        shown, own = np.array(self.shown).reshape(-1, 2), np.array(self.own).reshape(-1, 2)
        return shown[caught_up], own[caught_up]

    def travelled(self) -> float:
        """How far the robot's hand went from where it was at the start, at most [px]."""
        own = np.array(self.own)
        return float(np.linalg.norm(own - own[0], axis=1).max())

    def lag(self) -> int:
        """By how many steps the robot's hand comes later."""
        return lag_steps(*self.paths(), round(self.judging.largest_lag / self.period))

    def correlation(self) -> float:
        """Of the two paths, after the lag."""
        return correlation(*lag_taken_out(*self.paths(), self.lag()))

    def result(self, selection: str) -> dict[str, Any]:
        """What `metrics.json` says."""
        shown, own = self.paths()
        lag = self.lag()
        together = lag_taken_out(shown, own, lag)
        wanted, followed = self.visits()
        return {
            "selection": selection,
            "demonstrated_from": "demonstrator" if self.demonstrated else "seen hand",
            "own_from": "truth" if self._from_truth else "map read at the posture",
            "lag_s": lag * self.period if np.isfinite(rmse(*together)) else None,
            "path_rmse_px": rmse(*together),
            "raw_rmse_px": rmse(shown, own),
            "floor_rmse_px": self.floor(),
            "dtw_px": dtw(shown, own),
            "frechet_px": frechet(shown, own, self.judging.frechet_points),
            "correlation": correlation(*together),
            "jitter_px": jitter(own, self.period, *self.judging.jitter_hz),
            "areas_demonstrated": [list(visit.area) for visit in wanted],
            "areas_followed": [list(visit.area) for visit in followed],
            "follow_rate": len(followed) / len(wanted) if wanted else None,
        }

    def floor(self) -> float:
        """RMSE of the demonstrated path against the learned places of the areas it is in [px]."""
        shown, _ = self.paths()
        at = [self._learned_area(place) for place in shown]
        best = [UNSEEN if area is None else self._place_of(area) for area in at]
        return rmse(shown, np.array(best).reshape(-1, 2))

    def visits(self) -> tuple[list[Visit], list[Visit]]:
        """The demonstrator's visits to learned areas, and those that the robot followed."""
        shown = [self._learned_area(place) for place in self.shown]
        own = [
            self._learned_area(place) if self.in_area else self._near(place) for place in self.own
        ]
        # Half a period more, so that rounding does not shorten a visit.
        least = self.judging.shortest - self.period / 2
        made = visits(self.times, shown, self.period)
        wanted = [visit for visit in made if visit.end - visit.begin >= least]
        by_robot = visits(self.times, own, self.period)
        return wanted, followed_visits(wanted, by_robot, self.judging.grace)

    def _learned_area(self, place: Array) -> Area | None:
        return None if np.isnan(place[0]) else self.learned.learned_area(place)

    def _near(self, place: Array) -> Area | None:
        """The area whose learned place is near enough."""
        off = self.learned.distances(place)
        row, column = np.unravel_index(off.argmin(), off.shape)
        return (int(row), int(column)) if off[row, column] <= self.judging.near else None

    def _place_of(self, area: Area) -> Array:
        """Learned place of an area, that of its first posture."""
        return np.asarray(self.learned.places[area][self.learned.holds[area]][0])
