"""Watching an action once: what is seen of the hand becomes a sequence of states (section IV)."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.deciding import drawn_by, no_attractor
from imitation.dynamics import Dynamics, homeostatic
from imitation.perception import Perception
from imitation.robot import SECOND, Command, Robot
from imitation.sample import Event, Sample
from imitation.visual_field import winner_take_all
from imitation.visual_states import VisualState, VisualStates


@dataclass(frozen=True)
class Watching:
    """When a demonstration is over."""

    duration: float  # it ends here at the latest [s]
    gone: float  # it ends when the hand is gone for this long, after two states or more [s]


def demo_record(
    robot: Robot,
    perception: Perception,
    dynamics: Dynamics,
    states: VisualStates,
    watching: Watching,
    rest: Array,
) -> Iterator[Sample]:
    """Rest at the posture `rest` (n_joints,) [rad] and watch until the demonstration is over.

    A film that ends is its end too.
    """
    seen = robot.reset(rest)
    begun = shown = seen.time
    while seen.time - begun < watching.duration and not seen.ended:
        percept = perception.perceive(seen)
        captured = percept.time_ns / SECOND
        before = states.states[-1:]
        found = states.see(captured, percept.visual_input, percept.hand)
        events = (_told(found, len(states.states), before),) if found else ()
        selection = winner_take_all(percept.visual_input)
        attractors = no_attractor(len(seen.posture))
        decision = drawn_by(attractors, selection, seen.posture, dynamics, *homeostatic())
        command = Command(np.zeros_like(seen.posture))
        sensed, applied = robot.step(command)
        yield Sample(seen, percept, decision, command, applied, events)
        shown = captured if percept.hand is not None else shown
        if len(states.states) >= 2 and seen.time - shown > watching.gone:
            return
        seen = sensed


def _told(state: VisualState, number: int, before: list[VisualState]) -> Event:
    area, place = list(state.area), state.place.round(2).tolist()
    delay = round(state.time - before[0].time, 3) if before else 0.0
    since = f", {delay:.2f} s after the one before" if before else ""
    return Event(
        "state",
        f"state {number}: the hand rests in area {area}, at {place} px{since}",
        {"state": number - 1, "area": area, "seen_px": place, "delay_s": delay},
    )
