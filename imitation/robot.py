"""The robot: an arm and a camera joined behind one `step`, with the guard inside."""

from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np

from imitation.approach import Approach, lead
from imitation.arrays import Array, Image
from imitation.clock import SECOND as SECOND
from imitation.clock import Clock, SimulatedClock, WallClock
from imitation.guard import Guard


@dataclass(frozen=True)
class Body:
    """What an arm is: joints, limits and what its motors can do."""

    name: str
    joint_names: tuple[str, ...]
    lower: Array  # joint limits, (n_joints,) [rad]
    upper: Array
    speed: Array  # largest speed of each joint, (n_joints,) [rad/s]
    acceleration: Array  # largest acceleration of each joint, (n_joints,) [rad/s^2]


@dataclass(frozen=True)
class Shot:
    """One frame with when and where it was taken."""

    frame: Image
    time_ns: int
    gaze: Array  # pan, tilt [rad]
    place_noise: Array = field(default_factory=lambda: np.zeros(2))  # [px]
    jpeg: bytes | None = None  # what `frame` was decoded from; None: a simulated camera
    skipped: tuple["Shot", ...] = ()  # frames that came since the last one looked at, before this
    trouble: str | None = None  # why nothing should move while this is the newest; None: it may
    ended: bool = False  # no other frame will come


@dataclass(frozen=True)
class Observation:
    """What the robot senses at one control step."""

    time_ns: int  # when the joints were read, since the start of the run
    posture: Array  # proprioception x, (n_joints,) [rad]
    velocity: Array  # (n_joints,) [rad/s]
    gaze: Array  # pan, tilt of the neck, (2,) [rad]
    frame: Image  # newest frame, RGB, (height, width, 3)
    frame_time_ns: int  # when it was captured
    frame_gaze: Array  # gaze it was captured with, (2,) [rad]
    place_noise: Array  # added to the places seen in it, (2,) [px]; 0 for a real camera
    opening: float  # of the gripper, 0 closed .. 1 open
    proximity: float  # distance to what is between the fingers [m]; inf: nothing
    touching: bool  # both fingers touch something
    jpeg: bytes | None = None  # what `frame` was decoded from; None: a simulated camera
    skipped: tuple[Shot, ...] = ()  # frames that came since the step before, and before `frame`
    begins: bool = False  # an episode
    ended: bool = False  # the camera has no more frames to show

    @property
    def time(self) -> float:
        """When the joints were read, since the start of the run [s]."""
        return self.time_ns / SECOND


@dataclass(frozen=True)
class Command:
    """What a stage wants for one control period."""

    velocity: Array  # (n_joints,) [rad/s]; all 0: hold the posture
    grip: float | None = None  # wanted opening 0..1; None: as it is
    gaze: Array | None = None  # wanted pan, tilt [rad]; None: as it is


@dataclass(frozen=True)
class Applied:
    """What became of a command."""

    requested: Array  # velocity the stage asked for, (n_joints,) [rad/s]
    limited: Array  # what the guard left of it
    sent: Array  # what the arm made of that
    reasons: tuple[str, ...]  # why the guard changed it; empty: it did not
    time_ns: int  # when it was sent


@dataclass(frozen=True)
class Truth:
    """What only a simulation knows; no stage may ask for it."""

    time_ns: int
    hand_px: Array  # true centre of the mark on the hand in visual space, (2,) [px]
    hand_m: Array  # the same in the world, (3,) [m]
    object_pose: Array | None = None  # position [m] and quaternion x, y, z, w, (7,)


@dataclass(frozen=True)
class JointReading:
    """What an arm tells of itself."""

    posture: Array  # (n_joints,) [rad]
    velocity: Array  # (n_joints,) [rad/s]
    opening: float = 1.0
    proximity: float = float("inf")
    touching: bool = False


class Arm(Protocol):
    """An arm with a gripper that obeys joint velocities."""

    body: Body
    live: bool  # it lives in real time

    def reset(self, posture: Array) -> None:
        """Be at rest at `posture` [rad]."""

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """Move with `velocity` [rad/s] for `period` [s]; returns the velocity that was sent."""

    def read(self) -> JointReading:
        """Sense the joints and the gripper."""

    def truth(self) -> tuple[Array, Array | None] | None:
        """True position of the hand's mark and pose of the object; None on a real arm."""

    def close(self) -> None:
        """Stop the arm and release it; harmless when repeated."""


@runtime_checkable
class Limp(Protocol):
    """An arm that can be led by hand."""

    def go_limp(self) -> None:
        """Let the joints be moved from outside."""

    def go_stiff(self) -> None:
        """Hold the posture again."""


class Camera(Protocol):
    """A camera, on a neck or still."""

    live: bool  # it lives in real time

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """Turn to `gaze` (as it is when None) and return the newest frame."""

    def reset(self, time_ns: int) -> None:
        """Forget frames of the episode before."""

    def locate(self, position: Array) -> Array:
        """Where a point of the world [m] lies in visual space, (2,) [px]."""

    def close(self) -> None:
        """Release the camera; harmless when repeated."""


class Robot:
    """An arm watched by a camera. The only way to move it is through the guard.

    Its clock is the wall's when its arm or its camera lives in real time.
    """

    def __init__(
        self,
        arm: Arm,
        camera: Camera,
        guard: Guard,
        home: Array,
        period_ns: int,
        approach: Approach | None = None,
    ) -> None:
        self.arm, self.camera, self.guard, self.home = arm, camera, guard, home
        self.period_ns, self.live = period_ns, arm.live or camera.live
        self._approach, self.leading = approach, False  # it moves, but no step is under way
        self._clock: Clock = (WallClock if self.live else SimulatedClock)(period_ns)
        self._time_ns = 0
        self._velocity, self._posture = np.zeros(len(home)), home  # as sensed last
        self._trouble: str | None = None  # with the newest frame
        self._truths: list[Truth] = []

    @property
    def body(self) -> Body:
        """The arm's joints and limits."""
        return self.arm.body

    @property
    def period(self) -> float:
        """Control period [s]."""
        return self.period_ns / SECOND

    @property
    def late_ticks(self) -> int:
        """How many steps took longer than a period; 0 in simulation."""
        return self._clock.late

    def reset(self, posture: Array | None = None) -> Observation:
        """Be at rest at `posture` [rad] (home when None); an episode begins.

        A real arm is led there from wherever it is.
        """
        start = self.home if posture is None else posture
        self.arm.reset(self.guard.posture_within_limits(start))
        self._velocity = np.zeros(len(self.home))
        if self._approach:
            self._lead_to(start, self._approach)
        self._time_ns = self._clock.begin()
        self.camera.reset(self._time_ns)
        return self._sense(None, begins=True)

    def step(self, command: Command) -> tuple[Observation, Applied]:
        """Obey `command` within the guard's limits for one control period, then sense.

        While there is trouble with the newest frame, the arm comes to rest and stays there.
        """
        blind = (self._trouble,) if self._trouble else ()
        wanted = np.zeros(len(self.home)) if blind else command.velocity
        limited, reasons = self.guard.limit(wanted, self._velocity, self._posture, self.period)
        grip = None if blind else self.guard.opening_within_limits(command.grip)
        when = self._clock.now()
        sent = self.arm.move(limited, grip, self.period)
        applied = Applied(command.velocity, limited, sent, (*blind, *reasons), when)
        self._velocity = limited
        self._time_ns = self._clock.tick()
        turned = command.gaze is not None and np.isfinite(command.gaze).all()
        return self._sense(command.gaze if turned else None), applied

    def rest(self) -> None:
        """Brake as hard as the guard lets, and hold still; nothing is seen meanwhile."""
        still = np.zeros(len(self.home))
        while True:
            self._velocity, _ = self.guard.limit(still, self._velocity, self._posture, self.period)
            self.arm.move(self._velocity, None, self.period)
            self._clock.tick()
            if not self._velocity.any():
                return
            self._posture = self.arm.read().posture

    def truth(self) -> list[Truth]:
        """What was true at each sensing since this was last asked; empty on a real robot."""
        told, self._truths = self._truths, []
        return told

    def park(self, posture: Array) -> None:
        """Be at rest at `posture` [rad], if it is a real arm that parks; else where it is."""
        if self._approach and self._approach.park:
            self._lead_to(posture, self._approach)

    def close(self) -> None:
        """Stop the arm and release the devices; harmless when repeated."""
        self.arm.close()
        self.camera.close()

    def _lead_to(self, posture: Array, how: Approach) -> None:
        self.leading = True
        try:
            lead(self.arm, self.guard, posture, self._velocity, self.period_ns, how)
        finally:
            self.leading = False
        self._velocity = np.zeros(len(self.home))

    def _sense(self, gaze: Array | None, begins: bool = False) -> Observation:
        reading = self.arm.read()
        self._posture = reading.posture
        shot = self.camera.look(self._time_ns, gaze)
        self._trouble = shot.trouble
        truth = self.arm.truth()
        if truth is not None:
            mark, thing = truth
            self._truths.append(Truth(self._time_ns, self.camera.locate(mark), mark, thing))
        return Observation(
            time_ns=self._time_ns,
            posture=reading.posture,
            velocity=reading.velocity,
            gaze=shot.gaze,
            frame=shot.frame,
            frame_time_ns=shot.time_ns,
            frame_gaze=shot.gaze,
            place_noise=shot.place_noise,
            opening=reading.opening,
            proximity=reading.proximity,
            touching=reading.touching,
            jpeg=shot.jpeg,
            skipped=shot.skipped,
            begins=begins,
            ended=shot.ended,
        )
