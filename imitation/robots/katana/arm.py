"""The Katana as an arm that obeys joint velocities: each becomes a short position target."""

import time
from collections.abc import Callable

import numpy as np

from imitation.arrays import Array
from imitation.device import DeviceError
from imitation.grasp import OPEN
from imitation.robot import Body, JointReading
from imitation.robots.katana.commands import TICK, Flag, as_segments
from imitation.robots.katana.driver import Katana, refuse_crashed
from imitation.robots.katana.frames import BadReplyError
from imitation.robots.katana.models import Model
from imitation.robots.katana.sensors import GripperSensing
from imitation.robots.katana.start import ACCELERATION, FASTEST, Settings, make_ready
from imitation.robots.keeping_up import KeepingUp


class KatanaArm:
    """A real arm, or an emulated one.

    Args:
        katana: Its driver; the arm is identified, nothing moves.
        body: Joints and limits it is driven within.
        settings: How it is driven.
        sensing: What its gripper's sensors mean.
        clock: The time [s].

    Raises:
        DeviceError: It does not answer, or is another model.
    """

    live = True

    def __init__(
        self,
        katana: Katana,
        body: Body,
        settings: Settings,
        sensing: GripperSensing,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.katana, self.body = katana, body
        self._settings, self._sensing, self._clock = settings, sensing, clock
        self.identity = katana.identity()
        self._lower, self._upper = encoder_limits(body, katana.model)
        self._ready = False
        self._sent = self._sensed = katana.positions().astype(float)  # [encoders]
        self._read_at = clock()
        motors = [f"motor {number}" for number in range(1, 6)]
        self._keeping_up = KeepingUp(motors, settings.following, settings.overdue)
        self._grip: float | None = None
        self._lost = self._looks = 0
        self._ahead = np.round(self._sent)  # where the motors of a 300 were sent last
        self._busy_until = clock()  # with the segments it was sent
        self._nearby = (float("inf"), False)  # what the gripper sensed last

    def reset(self, posture: Array) -> None:
        """Be ready to move, at rest where the arm is; `Robot` leads it to `posture`, hand open."""
        if not self._ready:
            make_ready(self.katana, self.body, self._settings)
            self._ready = True
        self._sent = self.katana.positions().astype(float)
        self._ahead, self._grip = np.round(self._sent), OPEN

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """Move with `velocity` [rad/s] for `period` [s]; returns at once."""
        self._grip = self._grip if grip is None else grip
        model = self.katana.model
        ticks = self._ticks(period) if model.moves_all else round(period / TICK)
        target = self._sent.copy()
        target[:5] += velocity * model.per_radian * ticks * TICK
        target[5] += self._finger_step(ticks * TICK)
        target = self._within(target)
        if model.moves_all:
            self._all_towards(target, ticks)
        else:
            self._each_towards(target, period)
        moved = (target - self._sent)[:5] / model.per_radian / period
        self._sent = target
        return np.asarray(moved)

    def read(self) -> JointReading:
        """Sense the joints and, every other time, the gripper."""
        now, before = self._clock(), self._sensed
        self._sensed = self.katana.positions().astype(float)
        self._look_at_the_rest()
        if self._ready:
            away = (self._sensed - self._sent)[:5] / self.katana.model.per_radian
            self._keeping_up.check(np.abs(away), now)
        elapsed, self._read_at = max(now - self._read_at, TICK), now
        model = self.katana.model
        proximity, touching = self._nearby
        return JointReading(
            posture=model.angles(self._sensed[:5]),
            velocity=(self._sensed[:5] - before[:5]) / model.per_radian / elapsed,
            opening=model.opening(self._sensed[5]),
            proximity=proximity,
            touching=touching,
        )

    def truth(self) -> None:
        """Nobody knows the truth about a real arm."""

    def go_limp(self) -> None:
        """Switch the motors off: someone must hold the arm."""
        self.katana.switch_off()

    def go_stiff(self) -> None:
        """Hold the posture again."""
        self.katana.unblock()

    def close(self) -> None:
        """Freeze the arm and release it; harmless when repeated."""
        try:
            if self._ready:
                self.katana.freeze()
        except DeviceError:
            # The run has ended for this reason already; every movement sent ends by itself.
            pass
        finally:
            self._ready = False
            self.katana.close()

    def _within(self, target: Array) -> Array:
        """What of a target [encoders] keeps the limits, or leads back from beyond them."""
        lower, upper = np.minimum(self._lower, self._sent), np.maximum(self._upper, self._sent)
        return np.asarray(np.clip(target, lower, upper))

    def _ticks(self, period: float) -> int:
        """How long the next segment lasts, so that the arm has done it a period from now.

        What came late would be late for ever: segments queue up behind each other.
        """
        now = self._clock()
        left = now + period - max(now, self._busy_until)
        return max(min(round(left / TICK), round(period / TICK)), 1)

    def _finger_step(self, period: float) -> float:
        """How far the gripper goes on now [encoders]."""
        if self._grip is None:
            return 0.0
        model, settings = self.katana.model, self._settings
        way = model.opened - model.closed
        behind = (self._sensed[5] - self._sent[5]) / way
        if behind > settings.yielding:
            return 0.0  # it closes on something: press no harder
        to_go = model.gripper_encoder(self._grip) - self._sent[5]
        step = min(abs(way) * settings.finger_speed, FASTEST / TICK) * period
        return float(np.clip(to_go, -step, step))

    def _all_towards(self, target: Array, ticks: int) -> None:
        if (np.round(target) == np.round(self._sent)).all():
            return  # it holds
        segments = as_segments(np.round(self._sent), np.round(target), ticks)
        self._busy_until = max(self._busy_until, self._clock()) + ticks * TICK
        try:
            self.katana.move_all(segments)
            self._lost = 0
        except BadReplyError as error:
            # Once more would move it twice: stop, and go on from wherever it is.
            self._lost += 1
            if self._lost > self._settings.unsure:
                raise DeviceError(
                    f"{self._lost} movements in a row got no reply: {error}"
                ) from error
            self.katana.control(0, Flag.CLEAR, 0)
            target[:] = self.katana.positions()

    def _each_towards(self, target: Array, period: float) -> None:
        # Each motor brakes before its target: one that goes on is sent as much further.
        speed = (target - self._sent) / period * TICK
        further = np.sign(speed) * speed**2 / (2 * ACCELERATION)
        ahead = self._within(np.round(target + further))
        for motor, moves in enumerate(ahead != self._ahead, 1):
            if moves:
                self.katana.move(motor, int(ahead[motor - 1]))
        self._ahead = ahead

    def _look_at_the_rest(self) -> None:
        """The gripper's sensors and the motors' status, in turns: each look takes 40 ms."""
        self._looks += 1
        if self._looks % 2:
            sensors = self.katana.sensors()
            self._nearby = (self._sensing.proximity(sensors), self._sensing.touching(sensors))
        else:
            refuse_crashed(self.katana.statuses())


def encoder_limits(body: Body, model: Model) -> tuple[Array, Array]:
    """Smallest and largest encoder of the six motors, (6,) each: a body's limits and the arm's."""
    lower, upper = model.limits
    ends = np.sort([model.encoders(body.lower), model.encoders(body.upper)], axis=0)
    within = np.maximum(lower[:5], np.ceil(ends[0])), np.minimum(upper[:5], np.floor(ends[1]))
    return np.append(within[0], lower[5]), np.append(within[1], upper[5])
