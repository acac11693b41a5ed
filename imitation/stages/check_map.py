"""Checking a map: is the hand still seen where the learned postures bring it?"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from imitation.arrays import Array
from imitation.deciding import coming_to_rest, drawn_by, one_attractor
from imitation.dynamics import Dynamics, homeostatic
from imitation.perception import Perception
from imitation.robot import Command, Observation, Robot
from imitation.sample import Decision, Event, Sample


@dataclass(frozen=True)
class Visiting:
    """How learned postures are visited."""

    slowness: float  # time constant, in units of that of eq. 1
    arrival: float  # the arm is there when every joint is this near [rad]
    frames: int  # looked at in each posture, once the arm is there
    blocked: float  # a posture is given up after this long [s]


@dataclass
class Visit:
    """One learned posture, and where the hand was seen in it."""

    posture: Array  # (n_joints,) [rad]
    place: Array  # where it was seen when it was learned, (2,) [px]
    seen: list[Array] = field(default_factory=list)  # where it is seen now, (2,) [px] each

    @property
    def off(self) -> Array | None:
        """How far from there it is seen now, (2,) [px]; None when it was not seen."""
        return np.median(self.seen, axis=0) - self.place if self.seen else None


def check_map(
    robot: Robot,
    perception: Perception,
    dynamics: Dynamics,
    visits: Sequence[Visit],
    visiting: Visiting,
) -> Iterator[Sample]:
    """Visit learned postures slowly, one after the other, and look where the hand is seen."""
    seen = robot.reset()
    no_area = np.zeros(perception.field.shape)
    for number, visit in enumerate(visits):
        began, arrived_ns, frames = seen.time, -1, set[int]()
        while len(frames) < visiting.frames and seen.time - began < visiting.blocked:
            percept = perception.perceive(seen)
            there = np.all(np.abs(visit.posture - seen.posture) < visiting.arrival)
            if arrived_ns < 0 and there:
                arrived_ns = seen.time_ns
            if 0 <= arrived_ns < percept.time_ns and percept.time_ns not in frames:
                frames.add(percept.time_ns)
                visit.seen += [] if percept.hand is None else [percept.hand]
            decision = _drawn_to(visit, no_area, seen, robot, dynamics)
            command = Command(decision.velocity / visiting.slowness)
            before, (seen, applied) = seen, robot.step(command)
            done = len(frames) == visiting.frames
            yield Sample(before, percept, decision, command, applied, _told(number, visit, done))


def _drawn_to(
    visit: Visit, no_area: Array, seen: Observation, robot: Robot, dynamics: Dynamics
) -> Decision:
    gain, level = homeostatic()
    attractor = one_attractor(visit.posture)
    drawn = drawn_by(attractor, no_area, seen.posture, dynamics, gain, level, target=visit.place)
    return coming_to_rest(drawn, seen.posture, robot.body.acceleration, robot.period)


def _told(number: int, visit: Visit, done: bool) -> tuple[Event, ...]:
    if not done:
        return ()
    off = visit.off
    facts = {"place_px": visit.place.tolist(), "off_px": None if off is None else off.tolist()}
    where = "unseen" if off is None else f"{np.hypot(*off):.1f} px from where it was learned"
    return (Event("visited", f"posture {number + 1}: the hand is {where}", facts),)
