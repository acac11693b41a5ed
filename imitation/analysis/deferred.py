"""Deferred imitation in numbers: what was done, in which order, when, and to the object."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from imitation.analysis.place_prediction import place_shown_at
from imitation.analysis.visits import Order, in_order, visits_of
from imitation.arrays import Array
from imitation.robot import Observation, Truth
from imitation.sample import Sample
from imitation.visual_field import Area
from imitation.visuo_motor_map import VisuoMotorMap

PLACED = 0.04  # an object is where the demonstrator put it when it stands this near [m]
CARRIED_FOR = 1.0  # a thing that moves with the hand this long is grasped [s]
CARRIED_FAR = 0.02  # it must have moved this far in that time [m]
SLIPPED = 0.015  # and by no more than this otherwise than the hand [m]


def carried(times: Sequence[float], touching: Sequence[bool], hands: Array, things: Array) -> bool:
    """Whether both fingers touched a thing that moved with the hand for a second.

    Args:
        times: [s].
        touching: Both fingers touched something.
        hands: True places of the hand, (n, 3) [m].
        things: Of the thing, (n, 3) [m].
    """
    first = 0
    for last, time in enumerate(times):
        if not touching[last]:
            first = last + 1
            continue
        while first < last and time - times[first + 1] >= CARRIED_FOR:
            first += 1
        moved, with_hand = things[last] - things[first], hands[last] - hands[first]
        far = np.linalg.norm(moved) >= CARRIED_FAR
        together = np.linalg.norm(moved - with_hand) <= SLIPPED
        if time - times[first] >= CARRIED_FOR - 1e-9 and far and together:
            return True
    return False


@dataclass
class DeferredMetrics:
    """Follows a replay, sample by sample.

    Args:
        learned: The map in use.
        areas: The map's area of each state of the action; None where it learned nothing.
        times: When the demonstrator entered each state [s].
        goal: Where the demonstrator put the object, (3,) [m]; None without one.
    """

    learned: VisuoMotorMap
    areas: Sequence[Area | None]
    times: Sequence[float]
    goal: Array | None
    _truths: dict[int, Truth] = field(default_factory=dict)  # not yet decided on, the last at last
    _times: list[float] = field(default_factory=list)
    _hands_px: list[Array] = field(default_factory=list)
    _hands: list[Array] = field(default_factory=list)
    _things: list[Array] = field(default_factory=list)
    _touching: list[bool] = field(default_factory=list)
    _from_truth: bool = False
    _trigger: tuple[float, int] | None = None  # when [s], and which state was seen
    _ended: float = float("inf")
    _predicted: dict[int, float] = field(default_factory=dict)  # when, by state [s]

    def add(self, sample: Sample, truths: Iterable[Truth]) -> None:
        """Note one step and what was true around it."""
        time = sample.seen.time
        self._truths |= {truth.time_ns: truth for truth in truths}
        self._note(sample.seen, self._truths.pop(sample.seen.time_ns, None))
        for event in sample.events:
            state: Any = event.facts.get("state")
            if event.kind == "trigger" and self._trigger is None:
                self._trigger = (time, state)
                since: Any = event.facts["since_s"]
                self._predicted[state] = since
            elif event.kind == "predicted" and self._ended == np.inf:
                self._predicted[state] = time
            elif event.kind == "ended":
                self._ended = min(self._ended, time)

    def _note(self, seen: Observation, truth: Truth | None) -> None:
        """A real arm's hand is where the map expects it of the sensed posture."""
        nowhere = np.full(3, np.nan)
        pose = truth.object_pose if truth else None
        self._from_truth |= truth is not None
        self._times.append(seen.time)
        self._hands_px.append(
            truth.hand_px if truth else place_shown_at(self.learned, seen.posture)
        )
        self._hands.append(truth.hand_m if truth else nowhere)
        self._things.append(nowhere if pose is None else pose[:3])
        self._touching.append(seen.touching)

    def result(self) -> dict[str, Any]:
        """What `metrics.json` says."""
        order, asked = self._order()
        start, end = self._things[0] if self._things else None, self._end()
        return {
            "own_from": "truth" if self._from_truth else "map read at the posture",
            "triggered_at_s": self._trigger[0] if self._trigger else None,
            "triggered_by_state": self._trigger[1] if self._trigger else None,
            "states_asked": len(asked),
            "states_replayed": len(order.entries),
            "order_correct": order.correct and bool(asked),
            "timing_error_s": self._timing_errors(order, asked),
            "clock_error_s": self._clock_errors(),
            "grasped": self._grasped() if self._from_truth else None,
            "object_start_m": _place(start),
            "object_end_m": _place(end),
            "object_goal_m": _place(self.goal),
            "object_error_m": _apart(end, self.goal),
        }

    def path(self) -> Array:
        """The hand's way from the first state it went to until the action ended, (n, 2) [px].

        It begins when the next state is due: before, the arm comes from wherever it rests.
        """
        _, asked = self._order()
        begun = self._predicted.get(asked[1], np.inf) if len(asked) > 1 else np.inf
        during = [i for i, time in enumerate(self._times) if begun <= time <= self._ended]
        return np.array([self._hands_px[i] for i in during]).reshape(-1, 2)

    def _order(self) -> tuple[Order, list[int]]:
        """How the states after the trigger were entered, and which those are."""
        if self._trigger is None:
            return Order((), False), []
        begun, state = self._trigger
        asked = [k for k in range(state + 1, len(self.areas)) if self.areas[k] is not None]
        # States that follow each other in one area of a coarse map are one to it.
        asked = [
            k for i, k in enumerate(asked) if not i or self.areas[k] != self.areas[asked[i - 1]]
        ]
        known = [area for area in self.areas if area is not None]
        during = [i for i, time in enumerate(self._times) if begun <= time <= self._ended]
        times, hands = [self._times[i] for i in during], [self._hands_px[i] for i in during]
        visits = visits_of(times, hands, known, self.learned.field)
        return in_order(visits, [area for k in asked if (area := self.areas[k])]), asked

    def _timing_errors(self, order: Order, asked: Sequence[int]) -> list[float]:
        entered = np.diff(order.entries)
        shown = np.diff([self.times[k] for k in asked[: len(order.entries)]])
        return [float(error) for error in entered - shown] if len(order.entries) > 1 else []

    def _end(self) -> Array | None:
        """Where the object was at last, after the last step too."""
        poses = [truth.object_pose for truth in self._truths.values()]
        things = [*self._things, *(pose[:3] for pose in poses if pose is not None)]
        return things[-1] if things else None

    def _clock_errors(self) -> list[float]:
        states = sorted(self._predicted)
        played = np.diff([self._predicted[k] for k in states])
        shown = np.diff([self.times[k] for k in states])
        return [float(error) for error in played - shown] if len(states) > 1 else []

    def _grasped(self) -> bool:
        hands, things = np.array(self._hands), np.array(self._things)
        return carried(self._times, self._touching, hands, things)


def _place(position: Array | None) -> list[float] | None:
    return None if position is None or np.isnan(position).any() else position.tolist()


def _apart(end: Array | None, goal: Array | None) -> float | None:
    """Distance on the table [m]."""
    if end is None or goal is None or np.isnan(end).any():
        return None
    return float(np.linalg.norm(end[:2] - goal[:2]))


def acts_done(metrics: dict[str, Any]) -> float:
    """Share of the target acts of a replay that were done: each state in order, grasp, put down."""
    placed = metrics["object_error_m"] is not None and metrics["object_error_m"] <= PLACED
    done = metrics["states_replayed"] + bool(metrics["grasped"]) + placed
    return float(done / (metrics["states_asked"] + 2)) if metrics["states_asked"] else 0.0


def all_in_order(metrics: dict[str, Any]) -> bool:
    """Whether a replay did all target acts, in order."""
    return bool(metrics["order_correct"] and acts_done(metrics) == 1.0)
