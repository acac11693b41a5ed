"""An arm of bus servos that obeys joint velocities: each becomes a short position target."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from imitation.arrays import Array
from imitation.device import DeviceError
from imitation.grasp import OPEN
from imitation.robot import Body, JointReading
from imitation.robots.bodies import body_of
from imitation.robots.keeping_up import KeepingUp
from imitation.robots.servo_bus import ServoBus
from imitation.robots.servo_jaw import Jaw
from imitation.robots.servo_kinds import KINDS

Numbers = Sequence[float]

JAW_ACCELERATION = 10.0  # a jaw weighs nothing [rad/s^2]


@dataclass(frozen=True)
class Driving:
    """How the arm is driven.

    Args:
        senses: 1 or -1: whether a servo counts as its joint does, (n_joints,).
        torque: Largest torque [share of what a servo can].
        following: How far a joint may be from where it was sent [rad].
        overdue: For how long it may be [s].
        jaw: On the last servo of the bus; None: the arm has none.
    """

    senses: tuple[int, ...]
    torque: float
    following: float
    overdue: float
    jaw: Jaw | None = None


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
        self._jaw, self._joints = driving.jaw, len(body.lower)
        self._senses = np.array((*driving.senses, 1) if self._jaw else driving.senses, dtype=float)
        lower, upper = np.sort([self._senses * one for one in bus.limits()], axis=0)
        self.body = replace(
            body,
            lower=np.maximum(body.lower, lower[: self._joints]),
            upper=np.minimum(body.upper, upper[: self._joints]),
        )
        # Of all servos: those of the joints, and the jaw's.
        self._lower = np.append(self.body.lower, lower[self._joints :])
        self._upper = np.append(self.body.upper, upper[self._joints :])
        self._ready, self._looks, self._touching = False, 0, False
        self._grip: float | None = None
        self._sent = self._sensed = self._angles()
        self._read_at = clock()
        self._keeping_up = KeepingUp(body.joint_names, driving.following, driving.overdue)

    def reset(self, posture: Array) -> None:
        """Be ready to move, at rest where the arm is; `Robot` leads it to `posture`, jaw open."""
        self.bus.refuse_troubled()
        if not self._ready:
            self._limit()
            self._ready = True
        self.go_stiff()
        self._grip = OPEN if self._jaw else None

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """Move with `velocity` [rad/s] for `period` [s]; returns at once."""
        self._grip = self._grip if grip is None else grip
        wanted = self._sent.copy()
        wanted[: self._joints] += velocity * period
        if self._jaw and self._grip is not None:
            step = self._jaw.speed * period
            wanted[-1] += np.clip(self._jaw.angle(self._grip) - wanted[-1], -step, step)
        target = np.clip(wanted, self._lower, self._upper)
        moved = (target - self._sent) / period
        if moved.any():
            self.bus.turn_to(self._senses * target)
        self._sent = target
        return np.asarray(moved[: self._joints])

    def read(self) -> JointReading:
        """Sense the servos and, in turns, their trouble and what the jaw presses with."""
        now, before, joints = self._clock(), self._sensed, slice(self._joints)
        self._sensed = self._angles()
        self._looks += 1
        if self._looks % 2:
            self.bus.refuse_troubled()
        elif self._jaw:
            self._touching = bool(self.bus.loads()[-1] >= self._jaw.pressing)
        if self._ready:
            self._keeping_up.check(np.abs(self._sensed - self._sent)[joints], now)
        elapsed, self._read_at = max(now - self._read_at, 1e-3), now
        posture, velocity = self._sensed[joints], (self._sensed - before)[joints] / elapsed
        if self._jaw is None:
            return JointReading(posture, velocity)
        opening = self._jaw.opening(self._sensed[-1])
        proximity = self._jaw.proximity(opening, self._touching)
        return JointReading(posture, velocity, opening, proximity, self._touching)

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

    def _limit(self) -> None:
        body, jaw, driving = self.body, self._jaw, self._driving
        own = ([jaw.speed], [JAW_ACCELERATION], [jaw.torque]) if jaw else ([], [], [])
        torque = np.full(self._joints, driving.torque)
        limits = zip((body.speed, body.acceleration, torque), own, strict=True)
        self.bus.limit(*(np.append(joints, last) for joints, last in limits))

    def _hold(self) -> None:
        # The servos may be a little beyond their limits: their goal may not.
        self._sent, self._grip = np.clip(self._angles(), self._lower, self._upper), None
        self.bus.turn_to(self._senses * self._sent)

    def _angles(self) -> Array:
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
    servos: str,
    jaw: Mapping[str, Any] | None,
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
    own = Jaw(**jaw) if jaw else None
    all_ids = [*ids, own.id] if own else ids
    bus = ServoBus(address, KINDS[servos], all_ids, baud, timeout, tries)
    try:
        return ServoArm(bus, body, Driving(tuple(senses), torque, following, overdue, own))
    except Exception:
        bus.close()
        raise
