"""An arm of bus servos that obeys joint velocities: each becomes a short position target."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from imitation.arrays import Array
from imitation.device import DeviceError
from imitation.robot import Body, JointReading
from imitation.robots.bodies import body_of
from imitation.robots.keeping_up import KeepingUp
from imitation.robots.servo_bus import ServoBus

Numbers = Sequence[float]


@dataclass(frozen=True)
class Driving:
    """How the arm is driven.

    Args:
        senses: 1 or -1: whether a servo counts as its joint does, (n_joints,).
        torque: Largest torque [share of what a servo can].
        following: How far a joint may be from where it was sent [rad].
        overdue: For how long it may be [s].
    """

    senses: tuple[int, ...]
    torque: float
    following: float
    overdue: float


class ServoArm:
    """A real arm, or an emulated one; until its first reset nothing moves.

    Args:
        bus: Its servos.
        body: Joints and limits it is driven within, those of the servos too.
        driving: How.
        clock: The time [s].
    """

    live = True

    def __init__(
        self,
        bus: ServoBus,
        body: Body,
        driving: Driving,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.bus, self._driving, self._clock = bus, driving, clock
        self._senses = np.array(driving.senses, dtype=float)
        ends = np.sort([self._senses * one for one in bus.limits()], axis=0)
        self.body = replace(
            body, lower=np.maximum(body.lower, ends[0]), upper=np.minimum(body.upper, ends[1])
        )
        self._ready, self._looks = False, 0
        self._sent = self._sensed = self._posture()
        self._read_at = clock()
        self._keeping_up = KeepingUp(body.joint_names, driving.following, driving.overdue)

    def reset(self, posture: Array) -> None:
        """Be ready to move, at rest where the arm is; `Robot` leads it to `posture`."""
        self.bus.refuse_troubled()
        if not self._ready:
            self.bus.limit(self.body.speed, self.body.acceleration, self._driving.torque)
            self._ready = True
        self.go_stiff()

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """Move with `velocity` [rad/s] for `period` [s]; returns at once."""
        target = np.clip(self._sent + velocity * period, self.body.lower, self.body.upper)
        moved = (target - self._sent) / period
        if moved.any():
            self.bus.turn_to(self._senses * target)
        self._sent = target
        return np.asarray(moved)

    def read(self) -> JointReading:
        """Sense the joints and, every other time, the servos' trouble."""
        now, before = self._clock(), self._sensed
        self._sensed = self._posture()
        self._looks += 1
        if self._looks % 2:
            self.bus.refuse_troubled()
        if self._ready:
            self._keeping_up.check(np.abs(self._sensed - self._sent), now)
        elapsed, self._read_at = max(now - self._read_at, 1e-3), now
        return JointReading(self._sensed, (self._sensed - before) / elapsed)

    def truth(self) -> None:
        """Nobody knows the truth about a real arm."""

    def go_limp(self) -> None:
        """Switch the motors off: someone must hold the arm."""
        self.bus.torque(False)

    def go_stiff(self) -> None:
        """Hold the posture that the arm is in."""
        self._hold()
        self.bus.torque(True)

    def close(self) -> None:
        """Hold the posture and release the bus; harmless when repeated."""
        try:
            if self._ready:
                self._hold()
        except DeviceError:
            # The run has ended for this reason already; the servos hold their last target.
            pass
        finally:
            self._ready = False
            self.bus.close()

    def _hold(self) -> None:
        # The servos may be a little beyond their limits: their goal may not.
        self._sent = np.clip(self._posture(), self.body.lower, self.body.upper)
        self.bus.turn_to(self._senses * self._sent)

    def _posture(self) -> Array:
        return np.asarray(self._senses * self.bus.angles())


def servo_arm(
    name: str,
    urdf: str,
    joints: Sequence[str],
    base: Numbers,
    mark: Mapping[str, Any],
    speed: Numbers | None,
    acceleration: Numbers,
    address: str,
    baud: int,
    ids: Sequence[int],
    timeout: float,
    tries: int,
    senses: Sequence[int],
    torque: float,
    following: float,
    overdue: float,
) -> ServoArm:
    """A real arm of bus servos, or an emulated one; its servos are asked, nothing moves.

    Its mark is a real one: what the configuration says of it is for simulated arms.

    Raises:
        DeviceError: A servo does not answer, or is another model.
    """
    body = body_of(name, urdf, joints, base, speed, acceleration)
    for key, given in (("ids", ids), ("senses", senses)):
        if len(given) != len(joints):
            raise ValueError(f"robot.arm.{key} needs {len(joints)} numbers, got {list(given)}")
    bus = ServoBus(address, ids, baud, timeout, tries)
    try:
        return ServoArm(bus, body, Driving(tuple(senses), torque, following, overdue))
    except Exception:
        bus.close()
        raise
