"""Calibration of a Katana: only ever when it is asked for (facts/katana.md, 1.4 and 2.4)."""

import time

from imitation.device import DeviceError
from imitation.robots.katana.commands import MOTORS, Flag, Setting, Status
from imitation.robots.katana.driver import Katana
from imitation.robots.katana.models import Motor

BEYOND = 32000  # further than any stop [encoders]
FAR = 31000  # where a counter is set to so that the stop lies within its 16 bits
NEAR = 100  # arrived [encoders]
ALONE, TO_STOP = 0.2, 0.3  # between two looks [s]
SLOW = 25  # while searching a stop [encoders / 10 ms]


def calibrate(arm: Katana, limit: float) -> None:
    """Let the arm find its stops; it moves every motor to its end.

    Args:
        arm: What is calibrated.
        limit: How long each search may take [s].
    """
    if arm.model.calibrates_itself:
        _by_itself(arm, limit)
    else:
        _by_host(arm, limit)


def _by_itself(arm: Katana, limit: float) -> None:
    arm.control(0, Flag.CALIBRATE, BEYOND)
    until = time.monotonic() + limit
    while arm.motor(1).status == Status.CALIBRATING:
        if time.monotonic() > until:
            raise DeviceError(f"the arm still calibrates after {limit:.0f} s; is it blocked?")
        arm.sleep(ALONE)


def _by_host(arm: Katana, limit: float) -> None:
    for number in MOTORS:
        arm.set_counter(number, Flag.MOVE, 0)
    for number in sorted(MOTORS, key=lambda one: arm.model.motors[one - 1].order):
        motor = arm.model.motors[number - 1]
        _set_up(arm, number, motor, SLOW)
        arm.set_counter(number, Flag.FREEZE, -FAR * motor.stop)
        arm.control(number, Flag.MOVE, BEYOND * motor.stop)
        _wait_for_stop(arm, number, limit)
        arm.set_counter(number, Flag.FREEZE, 0)
        _set_up(arm, number, motor, motor.speed)
        arm.set_counter(number, Flag.MOVE, motor.offset)
        arm.control(number, Flag.MOVE, motor.ready)
        _wait_for_arrival(arm, number, motor.ready, limit)


def _set_up(arm: Katana, number: int, motor: Motor, speed: int) -> None:
    high, low = divmod(motor.crash_limit, 256)
    arm.set(number, Setting.PWM, motor.pwm, motor.pwm)
    arm.set(number, Setting.CONTROLLER, *motor.controller)
    arm.set(number, Setting.CRASH_LIMIT, high, low)
    arm.set(number, Setting.CRASH_LIMIT_LINEAR, high, low)
    arm.set(number, Setting.ACCELERATION, 1)
    arm.set(number, Setting.SPEED, speed, speed)


def _wait_for_stop(arm: Katana, number: int, limit: float) -> None:
    """Wait until a motor rests at its mechanical stop: two looks show the same place."""
    until, before = time.monotonic() + limit, None
    while (here := arm.motor(number).position) != before:
        if time.monotonic() > until:
            raise DeviceError(f"motor {number} found no stop in {limit:.0f} s")
        before = here
        arm.sleep(TO_STOP)


def _wait_for_arrival(arm: Katana, number: int, target: int, limit: float) -> None:
    until = time.monotonic() + limit
    while abs(arm.motor(number).position - target) >= NEAR:
        if time.monotonic() > until:
            raise DeviceError(f"motor {number} does not come back from its stop; is it blocked?")
        arm.sleep(ALONE)
