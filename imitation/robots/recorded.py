"""A robot that senses what a recording tells and goes nowhere: every command is ignored."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from imitation.arrays import Array
from imitation.guard import Guard
from imitation.robot import Body, JointReading, Observation, Robot, Shot
from imitation.sample import RecordedStep


@dataclass(frozen=True)
class Unrecorded(Observation):
    """Senses after the last ones of an episode: none were recorded, so they stay the same."""


class Tape:
    """The steps of a recording, one after the other.

    Args:
        steps: As they were recorded.
        period_ns: Control period [ns].
    """

    def __init__(self, steps: Iterator[RecordedStep], period_ns: int) -> None:
        self._steps, self._period_ns = steps, period_ns
        self._next = next(steps, None)
        if self._next is None:
            raise ValueError("the recording holds no step: there is nothing to decide on")
        self.now = self._next  # what is sensed

    def to_next_episode(self) -> None:
        """Go to where the next episode begins, if there is one."""
        if self._next is not self.now:  # the first episode begins at the start of the tape
            while self._next is not None and not self._next.begins:
                self._next = next(self._steps, None)
        self._forward()

    def go_on(self) -> None:
        """Go to the next step of the episode; at its end the senses stay as they are."""
        self._forward(within=True)

    def _forward(self, within: bool = False) -> None:
        if self._next is None or (within and self._next.begins):
            seen, over = self.now.seen, self._next is None
            later = {"time_ns": seen.time_ns + self._period_ns, "skipped": (), "ended": over}
            same = {**seen.__dict__, "begins": False, **later}
            self.now = replace(self.now, seen=Unrecorded(**same))
            return
        self.now, self._next = self._next, next(self._steps, None)


@dataclass
class RecordedArm:
    """An arm that tells where it was, and what it made of the command then."""

    body: Body
    tape: Tape
    live = False

    def reset(self, posture: Array) -> None:
        """Be where the next episode began."""
        self.tape.to_next_episode()

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """Be where the arm was one step later; returns the velocity that was sent then."""
        sent = self.tape.now.sent
        self.tape.go_on()
        return sent

    def read(self) -> JointReading:
        """Sense the joints and the gripper."""
        seen = self.tape.now.seen
        return JointReading(
            seen.posture, seen.velocity, seen.opening, seen.proximity, seen.touching
        )

    def truth(self) -> None:
        """No decision may rest on it."""

    def close(self) -> None:
        """Nothing to release."""


@dataclass
class RecordedCamera:
    """A camera that shows the frames of a recording."""

    tape: Tape
    live = False

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """The frame that was the newest then."""
        seen = self.tape.now.seen
        return Shot(
            frame=seen.frame,
            time_ns=seen.frame_time_ns,
            gaze=seen.frame_gaze,
            place_noise=seen.place_noise,
            jpeg=seen.jpeg,
            trouble=self.tape.now.trouble,
        )

    def reset(self, time_ns: int) -> None:
        """Nothing to forget."""

    def locate(self, position: Array) -> Array:
        """Unknown: a recording holds no world."""
        return np.full(2, np.nan)

    def close(self) -> None:
        """Nothing to release."""


@dataclass
class RecordedClock:
    """Tells when things happened then."""

    tape: Tape
    late = 0

    def begin(self) -> int:
        """When the episode began."""
        return self.tick()

    def tick(self) -> int:
        """When the senses came."""
        return self.tape.now.seen.time_ns

    def now(self) -> int:
        """When the command was sent."""
        return self.tape.now.sent_ns


class RecordedRobot(Robot):
    """A robot that lives through a recording again, with the guard inside.

    Args:
        body: The arm's joints and limits.
        guard: What no command may make the arm do.
        home: Its home posture, (n_joints,) [rad].
        period_ns: Control period [ns].
        steps: As they were recorded.
    """

    def __init__(
        self,
        body: Body,
        guard: Guard,
        home: Array,
        period_ns: int,
        steps: Iterator[RecordedStep],
    ) -> None:
        self._tape = Tape(steps, period_ns)
        arm, camera = RecordedArm(body, self._tape), RecordedCamera(self._tape)
        super().__init__(arm, camera, guard, home, period_ns)
        self._clock = RecordedClock(self._tape)

    def _sense(self, gaze: Array | None, begins: bool = False) -> Observation:
        super()._sense(gaze, begins)
        return self._tape.now.seen
