"""From samples and the simulation's truth to the numbers of `metrics.json`."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from imitation.analysis.place_prediction import prediction_errors
from imitation.arrays import Array
from imitation.hull import depth_inside
from imitation.robot import SECOND, Body, Truth
from imitation.sample import Sample
from imitation.visual_field import Area, VisualField
from imitation.visuo_motor_map import VisuoMotorMap


def place_errors(field_: VisualField, shown: dict[Area, Array]) -> dict[Area, float]:
    """Distance of where each revisited posture showed the hand to its area's centre [px]."""
    return {
        area: float(np.linalg.norm(place - field_.centres[area])) for area, place in shown.items()
    }


def neighbour_spread(learned: VisuoMotorMap) -> Array:
    """Distance between the postures of neighbouring learned areas, (n_pairs,) [-1..1]."""
    scaled = 2 * learned.postures[:, :, 0] / (learned.upper - learned.lower)
    across = np.linalg.norm(scaled[:, 1:] - scaled[:, :-1], axis=-1).ravel()
    down = np.linalg.norm(scaled[1:] - scaled[:-1], axis=-1).ravel()
    both = np.concatenate((across, down))
    return np.asarray(both[~np.isnan(both)])


def learn_map_metrics(learned: VisuoMotorMap, shown: dict[Area, Array]) -> dict[str, Any]:
    """What `metrics.json` says of a learned map.

    An area counts as learned when its posture, revisited, showed the hand inside it.
    """
    field_ = learned.field
    confirmed = {area for area, place in shown.items() if field_.area_of(place) == area}
    total = int(field_.reachable.sum())
    errors = list(place_errors(field_, shown).values())
    predicted, spread = prediction_errors(learned), neighbour_spread(learned)
    unseen = np.argwhere(field_.reachable & (learned.visits == 0))
    held = {(int(row), int(column)) for row, column in np.argwhere(learned.learned)}
    return {
        "areas_total": total,
        "areas_learned": len(confirmed),
        "coverage": len(confirmed) / total,
        "visits": learned.visits.tolist(),
        "place_error_px": _median(errors),
        "place_error_max_px": max(errors, default=None),
        "prediction_error_px": _median(predicted),
        "neighbour_spread": _median(spread),
        "neighbour_spread_max": float(spread.max()) if len(spread) else None,
        "areas_never_seen": unseen.tolist(),
        "areas_not_confirmed": sorted(list(area) for area in held - confirmed),
    }


def _median(values: Iterable[float]) -> float | None:
    listed = list(values)
    return float(np.median(listed)) if listed else None


@dataclass
class ReachMetrics:
    """Follows the trials of a reach run, sample by sample.

    Args:
        learned: The map in use.
        outline: Border of the learned region, (n, 2) [px].
        body: For the time that its speed limits allow.
        border: Targets nearer than this to the outline are a class of their own [px].
        holding: Success is a target held, not only reached.
    """

    learned: VisuoMotorMap
    outline: Array
    body: Body
    border: float
    holding: bool
    trials: list[dict[str, Any]] = field(default_factory=list)
    _truths: dict[int, Array] = field(default_factory=dict)
    _hands: list[Array] = field(default_factory=list)  # true hand since the start, (2,) [px]
    _path_px: float = 0.0  # its way
    _first: Sample | None = None
    _hold: dict[str, Any] = field(default_factory=dict)  # arrival at what may become a hold
    _hold_at: int = 0  # and from which of the hands on

    def add(self, sample: Sample, truths: Iterable[Truth]) -> None:
        """Note one step and what was true around it."""
        for truth in truths:
            self._truths[truth.time_ns] = truth.hand_px
        for event in sample.events:
            if event.kind == "episode":
                self._begin(sample)
        trial = self.trials[-1]
        true_hand = self._truths.pop(sample.seen.time_ns, None)
        if true_hand is not None:
            if self._hands:
                self._path_px += math.dist(true_hand, self._hands[-1])
            self._hands.append(true_hand)
        for event in sample.events:
            self._tell(event.kind, sample, trial)
        if np.isfinite(sample.decision.distance):
            trial["final_distance_px"] = sample.decision.distance
        if trial["time_s"] is None:
            trial["path_length_px"] = self._path_length()
        assert self._first is not None
        apart = np.abs(sample.seen.posture - self._first.seen.posture) / self.body.speed
        trial["time_bound_s"] = float(apart.max())

    def _tell(self, kind: str, sample: Sample, trial: dict[str, Any]) -> None:
        if kind == "reached":
            trial["reached"] = True
        if kind == "settled":
            self._hold, self._hold_at = self._arrival(sample), len(self._hands) - 1
        if kind == ("held" if self.holding else "reached"):
            trial |= self._hold if self.holding else self._arrival(sample)
        if kind == "held":
            trial["held"] = True
            off = [math.dist(hand, trial["target_px"]) for hand in self._hands[self._hold_at :]]
            trial["true_distance_px"] = max(off, default=None)

    def _begin(self, sample: Sample) -> None:
        target = sample.decision.target
        assert target is not None
        self._first, self._hands, self._path_px = sample, [], 0.0
        _, places = self.learned.memories()
        active = int(((sample.decision.selection > 0) & self.learned.learned).sum())
        depth = depth_inside(self.outline, target)
        self.trials.append(
            {
                "target_px": target.tolist(),
                "start_posture": sample.seen.posture.tolist(),
                "reached": False,
                "held": False,
                "final_distance_px": None,
                "true_distance_px": None,
                "time_s": None,
                "activated": active,
                "nearest_attractor_px": float(np.linalg.norm(places - target, axis=1).min()),
                "path_length_px": None,
                "straight_px": None,
                "time_bound_s": None,
                "border": depth < self.border,
            }
        )

    def _arrival(self, sample: Sample) -> dict[str, Any]:
        """What is told of the first frame at the target."""
        assert self._first is not None
        hands = self._hands
        return {
            "time_s": (sample.seen.time_ns - self._first.seen.time_ns) / SECOND,
            "path_length_px": self._path_length(),
            "straight_px": math.dist(hands[0], hands[-1]) if hands else None,
        }

    def _path_length(self) -> float | None:
        return self._path_px if self._hands else None

    def result(self, controller: str) -> dict[str, Any]:
        """What `metrics.json` says."""
        reached = [trial["reached"] for trial in self.trials]
        held = [trial["held"] for trial in self.trials]
        done = held if self.holding else reached
        times = [trial["time_s"] for trial, ok in zip(self.trials, done, strict=True) if ok]
        return {
            "controller": controller,
            "trials": self.trials,
            "success_rate": float(np.mean(done)) if done else None,
            "reached_rate": float(np.mean(reached)) if reached else None,
            "held_rate": float(np.mean(held)) if held else None,
            "median_time_s": _median(times),
        }
