"""Deferred imitation: seeing a hand at a learned state lets the action follow (section IV)."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Mask
from imitation.deciding import drawn_by, no_attractor
from imitation.dynamics import Dynamics
from imitation.enacting import Enactor, Phase
from imitation.grasp import Hand
from imitation.perception import Perception
from imitation.recall import Recall
from imitation.robot import Command, Observation, Robot
from imitation.sample import Event, Sample


@dataclass(frozen=True)
class Ending:
    """When a replay ends."""

    patience: float  # when nothing has triggered the action by then [s]
    after: float  # this long after the arm is back at rest [s]
    limit: float  # at the latest [s]


def replay(
    robot: Robot,
    perception: Perception,
    recall: Recall,
    enactor: Enactor,
    dynamics: Dynamics,
    ending: Ending,
) -> Iterator[Sample]:
    """Wait for a hand at a state of the action, then play the action to its end.

    Whose hand it is makes no difference; while the action plays, none triggers.
    """
    seen = robot.reset(enactor.rest)
    until, latest = seen.time + ending.patience, seen.time + ending.limit
    while seen.time <= (until if recall.state is None else latest):
        percept = perception.perceive(seen, attended(recall, enactor))
        events = recall.notice(percept)
        if enactor.phase is Phase.RESTING and recall.coming is not None:
            enactor.make_ready(recall.coming)
        if predicted := recall.predict(seen.time):
            enactor.go_to(recall.place, recall.loop.over)
            events.append(predicted)
        before = enactor.phase, enactor.reflex.hand
        decision = enactor.decide(seen, percept, dynamics)
        command = Command(decision.velocity, enactor.act(seen))
        enactor.go_on()
        events += _told(before, enactor, recall)
        if recall.over and enactor.rests(seen.time_ns, percept.time_ns):
            recall.end()
            until = seen.time + ending.after
        elif seen.ended and recall.state is None:
            until = min(until, seen.time)
        sensed, applied = robot.step(command)
        try:
            yield Sample(seen, percept, decision, command, applied, tuple(events))
        except KeyboardInterrupt:
            yield from _stopped(robot, perception, sensed, dynamics, recall)
            raise
        seen = sensed
    if recall.state is not None:
        yield from _stopped(robot, perception, seen, dynamics, recall)


def attended(recall: Recall, enactor: Enactor) -> Mask | None:
    """Areas that a hand counts in, (rows, columns): all (None) until an action plays."""
    return None if recall.state is None else enactor.attended & ~recall.staying


def _told(before: tuple[Phase, Hand], enactor: Enactor, recall: Recall) -> Iterator[Event]:
    """What arm and hand have begun at this step."""
    phase, hand = enactor.phase, enactor.reflex.hand
    if hand is not before[1]:
        yield Event("grip", f"the hand is {hand.value}", {"hand": hand.value})
    if phase is before[0] or recall.state is None:
        return
    facts: dict[str, object] = {"state": recall.state, "phase": phase.value}
    yield Event("arm", f"the arm {phase.value} {recall.called}", facts)
    if phase is Phase.LEAVING:
        yield Event("ended", "the action is over", {"state": recall.state})


def _stopped(
    robot: Robot, perception: Perception, seen: Observation, dynamics: Dynamics, recall: Recall
) -> Iterator[Sample]:
    """Stop the arm, and say in which state the action was."""
    told = Event("stopped", f"stopped {recall.where}", {"state": recall.state})
    events: tuple[Event, ...] = (told,)
    moving = True
    while moving:
        percept = perception.perceive(seen)
        nowhere = np.zeros(perception.field.shape)
        decision = drawn_by(no_attractor(len(seen.posture)), nowhere, seen.posture, dynamics, 0.0)
        command = Command(decision.velocity)
        sensed, applied = robot.step(command)
        yield Sample(seen, percept, decision, command, applied, events)
        seen, events, moving = sensed, (), bool(applied.limited.any())
