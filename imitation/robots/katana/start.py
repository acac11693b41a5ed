"""Makes a Katana ready: nothing moves that was not asked for (facts/katana.md, 2.4)."""

from dataclasses import dataclass

import numpy as np

from imitation.device import DeviceError
from imitation.robot import Body
from imitation.robots.katana.calibration import calibrate
from imitation.robots.katana.commands import TICK, Status
from imitation.robots.katana.driver import Katana, refuse_crashed

FASTEST = 180  # the protocol's largest speed [encoders / tick]
ACCELERATION = 2  # its largest acceleration [encoders / tick^2]


@dataclass(frozen=True)
class Settings:
    """How the arm is driven.

    Args:
        calibrate: Whether it may search its stops when it begins.
        unblock: Whether crash flags are cleared, and motors that are off switched on, then.
        patience: How long one search for a stop may take [s].
        following: How far a joint may be from where it was sent [rad].
        overdue: For how long it may be [s].
        finger_speed: Of the gripper [share of its way / s].
        yielding: How far the gripper may stay behind when it closes on something [share].
        unsure: How often in a row a reply to a movement may be lost.
    """

    calibrate: bool
    unblock: bool
    patience: float
    following: float
    overdue: float
    finger_speed: float
    yielding: float
    unsure: int


def make_ready(katana: Katana, body: Body, settings: Settings) -> None:
    """Calibrate or unblock the arm if that was asked for; then limit its speeds.

    Raises:
        DeviceError: A motor has collided or is switched off.
    """
    if settings.calibrate:
        calibrate(katana, settings.patience)
    elif settings.unblock:
        katana.unblock()
    statuses = katana.statuses()
    refuse_crashed(statuses)
    if Status.OFF in statuses:
        raise DeviceError(
            f"motor {statuses.index(Status.OFF) + 1} is switched off: when the arm has been "
            "without power type robot.arm.driving.calibrate=true (it then moves to all its stops), "
            "else robot.arm.driving.unblock=true"
        )
    katana.limit_crashes(True)
    model = katana.model
    fastest = np.abs(body.speed * model.per_radian) * TICK
    finger = abs(model.opened - model.closed) * settings.finger_speed * TICK
    limits = np.minimum(np.ceil([*fastest, finger]), FASTEST)
    katana.set_limits(limits.astype(int).tolist(), ACCELERATION)
