"""Learning the visuo-motor map: the arm babbles, sees its own hand, and learns (section II)."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.deciding import coming_to_rest, drawn_by
from imitation.dynamics import Dynamics, homeostatic
from imitation.pairing import PostureHistory
from imitation.perception import Perception
from imitation.robot import Command, Observation, Robot
from imitation.sample import Decision, Event, Sample
from imitation.stages.babbling import Babbling, Goal
from imitation.visual_field import Area
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass(frozen=True)
class LearningRun:
    """When babbling moves on and when it ends."""

    limit: float  # babbling and revisiting together end here [s]
    patience: float  # babbling ends when no area was new for this long [s]
    arrival: float  # a posture is reached when every joint is this near [rad]
    blocked: float  # a goal is given up when the arm gets no farther for this long [s]
    pairing: float  # frames older than this are not paired with a posture [s]


@dataclass
class Learner:
    """Moves the arm to one goal after another and lets the map learn from every frame."""

    robot: Robot
    perception: Perception
    dynamics: Dynamics
    learned: VisuoMotorMap
    run: LearningRun

    def __post_init__(self) -> None:
        self.history = PostureHistory(self.run.pairing)
        self.shown: dict[Area, Array] = {}  # where each revisited posture showed the hand [px]
        self.places: list[Array] = []  # everywhere the hand was seen [px]

    def begin(self) -> None:
        """Be at the home posture: from here on time counts."""
        self.seen = self.robot.reset()
        self.begun = self.seen.time  # [s]

    @property
    def late(self) -> bool:
        """Whether the limit has come."""
        return self.seen.time - self.begun >= self.run.limit

    def move(self, goal: Goal, babbling: Babbling | None) -> Iterator[Sample]:
        """Go to `goal` and yield the steps; learn on the way when `babbling`."""
        arrived: int | None = None
        moved, there = self.seen.time, self.seen.posture
        while self.seen.time - moved < self.run.blocked and not self.late:
            seen = self.seen
            self.history.note(seen.time_ns, seen.posture)
            percept = self.perception.perceive(seen)
            events = []
            if percept.hand is not None and babbling is not None:
                posture = self.history.at(percept.time_ns)
                new = self._learn(percept.visual_input, posture, percept.hand, babbling)
                events += [new] if new else []
            if arrived is None and np.all(np.abs(goal.posture - seen.posture) < self.run.arrival):
                arrived = seen.time_ns
            # A revisit waits for a frame that shows the arm where it came to rest.
            waiting = babbling is None and percept.time_ns <= (arrived or seen.time_ns)
            if arrived is not None and not waiting:
                if babbling is None and goal.area is not None and percept.hand is not None:
                    self.shown[goal.area] = percept.hand
                    events.append(_told("visited", goal.area, percept.hand, "is visited"))
                if not events:
                    return
            decision = self._drawn_to(goal, seen)
            command = Command(decision.velocity)
            self.seen, applied = self.robot.step(command)
            yield Sample(seen, percept, decision, command, applied, tuple(events))
            # What the arm was told does not tell whether something stands in its way.
            if arrived is not None or np.any(np.abs(self.seen.posture - there) > self.run.arrival):
                moved, there = self.seen.time, self.seen.posture
            if arrived is not None and not waiting:
                return

    def _learn(
        self, visual_input: Array, posture: Array, place: Array, babbling: Babbling
    ) -> Event | None:
        before = self.learned.learned
        babbling.remember(place, posture)
        self.places.append(place)
        area = self.learned.learn(visual_input, posture, place)
        if area is None or before[area]:
            return None
        return _told("learned", area, place, f"is learned, {self.learned.learned.sum()} in all")

    def _drawn_to(self, goal: Goal, seen: Observation) -> Decision:
        gain, level = homeostatic()
        decision = drawn_by(
            goal.attractor,
            goal.selection,
            seen.posture,
            self.dynamics,
            gain,
            level,
            target=goal.place,
        )
        body, period = self.robot.body, self.robot.period
        return coming_to_rest(decision, seen.posture, body.acceleration, period)


def _told(kind: str, area: Area, place: Array, what: str) -> Event:
    row, column = area
    facts = {"area": [row, column], "place_px": [round(float(p), 2) for p in place]}
    return Event(kind, f"area [{row}, {column}] {what}", facts)


def learn_map(learner: Learner, babbling: Babbling) -> Iterator[Sample]:
    """Babble until the map is full, then revisit what was learned.

    Ends early when no area was new for `patience` seconds, or at the limit.
    """
    learned, patience = learner.learned, learner.run.patience
    learner.begin()
    news, count = learner.begun, 0
    while not babbling.content(learned) and not learner.late:
        if learner.seen.time - news > patience:
            break
        yield from learner.move(babbling.next_goal(learned, learner.seen.posture), babbling)
        if learned.learned.sum() > count:
            news, count = learner.seen.time, int(learned.learned.sum())
    remaining = {(int(row), int(column)) for row, column in np.argwhere(learned.learned)}
    while remaining and not learner.late:
        goal = babbling.nearest_learned(learned, remaining, learner.seen.posture)
        remaining.discard(goal.area or (-1, -1))
        yield from learner.move(goal, None)
