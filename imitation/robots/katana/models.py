"""What the Katana 300, 400 and 450 are, from the vendor's configuration (facts/katana.md, 1.4).

Data of the devices, not to be tuned.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from imitation.arrays import Array

MOTORS = 6  # the last one is the gripper's
TURN = 2 * np.pi
PORT, BAUD = 5566, 57600
# URDF angle = KNI angle + this; no joint's range reaches beyond [-pi, pi).
URDF_OFFSET = np.array([-np.pi, 0.0, -np.pi, -np.pi, -np.pi])


@dataclass(frozen=True)
class Motor:
    """One motor as the vendor's configuration file has it."""

    offset: int  # encoder at the calibration stop [encoders]
    per_turn: int  # [encoders / turn]
    angle: float  # at the stop [deg]
    range: float  # from there [deg]
    direction: int  # 1: the angle falls as encoders grow
    speed: int  # [encoders / 10 ms]
    order: int  # in calibration
    pwm: int  # largest
    controller: tuple[int, int, int]  # kspeed, kpos, kI
    crash_limit: int

    @property
    def limits(self) -> tuple[int, int]:
        """Smallest and largest encoder."""
        far = self.offset - self.direction * int(self.per_turn * self.range / 360)
        return min(self.offset, far), max(self.offset, far)

    @property
    def stop(self) -> int:
        """Sense in which the calibration stop is searched, -1 or 1."""
        return 1 if self.offset > 0 else -1

    @property
    def ready(self) -> int:
        """Where calibration leaves the motor [encoders]."""
        return self.offset - 1000 * self.stop


@dataclass(frozen=True)
class Model:
    """A Katana 6M180 of one make."""

    name: str
    firmware: tuple[int, ...]  # versions of the master that belong to it
    serial: bool  # RS-232, else TCP
    moves_all: bool  # H moves all motors in one call (2.6)
    calibrates_itself: bool  # C 4 (2.6)
    tells_errors: bool  # the error flag (2.5)
    opened: int  # gripper [encoders]
    closed: int
    motors: tuple[Motor, ...]

    def column(self, name: str) -> Array:
        """A value of all six motors, (6,)."""
        return np.array([getattr(motor, name) for motor in self.motors], dtype=float)

    @cached_property
    def limits(self) -> tuple[Array, Array]:
        """Smallest and largest encoder of the six motors, (6,) each."""
        lower, upper = np.array([motor.limits for motor in self.motors]).T
        return lower, upper

    @cached_property
    def joint_limits(self) -> tuple[Array, Array]:
        """Lower and upper joint limits, (5,) [rad]."""
        ends = np.array([self.angles(end[:5]) for end in self.limits])
        return ends.min(axis=0), ends.max(axis=0)

    @cached_property
    def per_radian(self) -> Array:
        """Encoders for each radian of a joint, with its sign, (5,)."""
        return np.asarray(-self.column("per_turn")[:5] * self.column("direction")[:5] / TURN)

    def angles(self, encoders: Array) -> Array:
        """URDF joint angles (5,) [rad] at `encoders` (5,)."""
        away = np.asarray(encoders) - self.column("offset")[:5]
        return np.asarray(self._stop_angles + away / self.per_radian)

    def encoders(self, angles: Array) -> Array:
        """Encoders (5,) at URDF joint angles (5,) [rad], not rounded."""
        turned = np.asarray(angles) - self._stop_angles
        return np.asarray(self.column("offset")[:5] + turned * self.per_radian)

    def opening(self, encoder: float) -> float:
        """Opening 0..1 of the gripper at `encoder`."""
        share = (encoder - self.closed) / (self.opened - self.closed)
        return float(np.clip(share, 0.0, 1.0))

    def gripper_encoder(self, opening: float) -> int:
        """Encoder of the gripper at `opening` 0..1."""
        return round(self.closed + float(np.clip(opening, 0.0, 1.0)) * (self.opened - self.closed))

    @property
    def _stop_angles(self) -> Array:
        return np.asarray(np.radians(self.column("angle")[:5]) + URDF_OFFSET)


Row = tuple[int, float, float, int, int, tuple[int, int, int], int]


def _motors(*rows: Row) -> tuple[Motor, ...]:
    # Stop, sense of turning and order of calibration are the same for all models.
    shared = [(31000, 1, 5), (-31000, 1, 0), (-31000, -1, 1), (31000, 1, 2), (31000, 1, 3)]
    shared.append((31000, 1, 4))
    return tuple(
        Motor(offset, per_turn, angle, span, direction, speed, order, pwm, gains, crash)
        for (offset, direction, order), row in zip(shared, rows, strict=True)
        for per_turn, angle, span, speed, pwm, gains, crash in (row,)
    )


K300 = Model(
    name="300",
    firmware=(4,),
    serial=True,
    moves_all=False,
    calibrates_itself=False,
    tells_errors=False,
    opened=31000,
    closed=-16768,
    motors=_motors(
        (51200, 6.65, 346.7, 30, 100, (15, 2, 100), 800),
        (94976, 124.25, -143.0, 25, 127, (7, 2, 100), 800),
        (81408, 52.7, 250.0, 25, 100, (15, 2, 100), 800),
        (51200, 63.5, 233.0, 25, 127, (2, 2, 100), 800),
        (51200, 8.5, 344.0, 25, 127, (7, 2, 100), 800),
        (51200, -123.2, 337.0, 25, 127, (4, 1, 100), 800),
    ),
)
K400 = Model(
    name="400",
    firmware=(0, 1),
    serial=False,
    moves_all=True,
    calibrates_itself=True,
    tells_errors=True,
    opened=30770,
    closed=12240,
    motors=_motors(
        (51200, 6.65, 346.0, 30, 127, (80, 10, 50), 250),
        (94976, 124.25, -140.0, 25, 100, (60, 10, 200), 200),
        (47488, 52.7, 250.0, 20, 80, (50, 10, 200), 250),
        (51200, 63.5, 230.0, 25, 100, (60, 20, 250), 200),
        (51200, 8.5, 342.0, 25, 127, (35, 40, 180), 100),
        (51200, -123.2, 337.0, 25, 127, (50, 20, 150), 100),
    ),
)
K450 = replace(
    K400,
    name="450",
    firmware=(2, 3),
    motors=tuple(
        replace(motor, range=span, angle=angle)
        for motor, (span, angle) in zip(
            K400.motors,
            ((339, 6.65), (-132, 124.25), (245, 52.7), (224, 63.5), (336, 8.5), (329, -119.5)),
            strict=True,
        )
    ),
)


def for_slaves(model: Model, third: int) -> Model:
    """The model whose third motor's controller has this version: an old one counts finer."""
    if model is not K300 or third >= 2:
        return model
    motors = list(model.motors)
    motors[2] = replace(motors[2], per_turn=94976)
    return replace(model, motors=tuple(motors))


MODELS = {model.name: model for model in (K300, K400, K450)}
