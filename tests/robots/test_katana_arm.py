"""The Katana as an arm: what its velocities become, and what it does when something goes wrong."""

import numpy as np
import pytest
from katana_wired import wired

from imitation.device import DeviceError
from imitation.robots.katana.commands import Status

PERIOD = 0.16  # [s]
SLOW = np.array([0.1, -0.1, 0.1, 0.1, 0.1])  # away from every stop [rad/s]
EVERY = pytest.mark.parametrize("model", ["300", "400", "450"])


def go(arm, wire, velocity, steps: int, grip: float | None = None):
    """What is sensed after so many steps."""
    for _ in range(steps):
        arm.move(velocity, grip, PERIOD)
        wire.pass_time(PERIOD)
        seen = arm.read()
    return seen


@EVERY
def test_velocities_lead_each_joint_by_velocity_times_time(model, tmp_path):
    with wired(model, tmp_path) as (arm, wire, _):
        arm.reset(arm.body.lower)
        start = arm.read().posture
        go(arm, wire, SLOW, 10)
        seen = go(arm, wire, 0 * SLOW, 5)
        assert seen.posture == pytest.approx(start + SLOW * 10 * PERIOD, abs=0.001)
        assert seen.velocity == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("model", ["400", "450"])
def test_steps_that_come_late_do_not_queue_up(model, tmp_path):
    with wired(model, tmp_path) as (arm, wire, _):
        arm.reset(arm.body.lower)
        for late in (0.1, -0.1, 0.05, -0.05, 0.0, 0.0):
            go(arm, wire, SLOW, 1)
            wire.pass_time(late)
        behind = arm.read().posture - arm.katana.model.angles(arm._sent[:5])
        assert behind == pytest.approx(0, abs=0.005)


@EVERY
def test_a_joint_is_never_sent_beyond_its_range(model, tmp_path):
    with wired(model, tmp_path, following=9.0) as (arm, wire, _):
        arm.reset(arm.body.lower)
        towards_the_stop = -np.sign(SLOW) * 0.7
        for velocity, steps in ((towards_the_stop, 6), (-towards_the_stop, 60)):
            seen = go(arm, wire, velocity, steps)
            assert (seen.posture >= arm.body.lower - 1e-3).all()
            assert (seen.posture <= arm.body.upper + 1e-3).all()


@EVERY
def test_the_gripper_closes_and_opens_at_its_speed(model, tmp_path):
    with wired(model, tmp_path, finger_speed=0.5) as (arm, wire, _):
        arm.reset(arm.body.lower)
        assert 0.5 < go(arm, wire, 0 * SLOW, 5, grip=0.0).opening < 0.9
        assert go(arm, wire, 0 * SLOW, 25).opening == pytest.approx(0.0, abs=0.02)
        assert go(arm, wire, 0 * SLOW, 30, grip=1.0).opening == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize("model", ["400", "450"])
def test_the_gripper_feels_what_it_closes_on_and_presses_no_harder(model, tmp_path):
    with wired(model, tmp_path) as (arm, wire, _):
        arm.reset(arm.body.lower)
        assert go(arm, wire, 0 * SLOW, 2).proximity == np.inf
        wire.device.arm.sensors.thing = arm.katana.model.gripper_encoder(0.5)
        seen = go(arm, wire, 0 * SLOW, 2)
        assert seen.proximity < 0.05
        assert not seen.touching
        seen = go(arm, wire, 0 * SLOW, 25, grip=0.0)
        assert seen.touching
        assert seen.opening == pytest.approx(0.5, abs=0.02)


@EVERY
def test_closing_freezes_the_arm_where_it_is(model, tmp_path):
    with wired(model, tmp_path) as (arm, wire, _):
        arm.reset(arm.body.lower)
        go(arm, wire, SLOW, 3)
        arm.move(SLOW, None, PERIOD)
        arm.close()
        assert {motor.doing.name for motor in wire.device.arm.motors} == {"HOLDING"}
        arm.close()


@EVERY
def test_an_arm_that_was_only_looked_at_is_left_as_it_is(model, tmp_path):
    with wired(model, tmp_path) as (arm, wire, _):
        wire.device.arm.motors[0].move(20000)
        arm.read()
        arm.close()
        assert wire.device.arm.motors[0].doing.name == "MOVING"


@EVERY
@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ("crashed_motor=2@1", "motor 2"),
        ("stuck_motor=3@1", "motor 3 .* does not move"),
        ("stuck_encoder=3@1", "motor 3 .* does not move"),
        ("silence@1", "in vain|no reply"),
        ("wrong_crc@1", "wrong CRC"),
        ("cut@1", "cut|failed"),
    ],
)
def test_what_goes_wrong_ends_in_one_sentence(model, fault, told, tmp_path):
    with wired(model, tmp_path, fault) as (arm, wire, _):
        arm.reset(arm.body.lower)
        with pytest.raises(DeviceError, match=told):
            go(arm, wire, SLOW, 30)
        arm.close()


@pytest.mark.parametrize("fault", ["silence@1x2", "wrong_crc@1x2", "late@1x1", "split@1-2"])
@pytest.mark.parametrize("model", ["300", "400"])
def test_what_goes_wrong_for_a_moment_is_passed_over(model, fault, tmp_path):
    with wired(model, tmp_path, fault) as (arm, wire, _):
        arm.reset(arm.body.lower)
        start = arm.read().posture
        go(arm, wire, SLOW, 12)
        seen = go(arm, wire, 0 * SLOW, 3)
        moved = (seen.posture - start) / (SLOW * 12 * PERIOD)
        assert (moved > 0.7).all()  # what was uncertain is given up, nothing is done twice
        assert (moved < 1.05).all()


@EVERY
def test_motors_that_are_off_are_switched_on_only_when_asked(model, tmp_path):
    with wired(model, tmp_path) as (arm, _, _):
        arm.katana.switch_off()
        with pytest.raises(DeviceError, match=r"motor 1 is switched off: .*unblock=true"):
            arm.reset(arm.body.lower)
    with wired(model, tmp_path, unblock=True) as (arm, _, _):
        arm.katana.switch_off()
        arm.reset(arm.body.lower)
        assert set(arm.katana.statuses()) == {Status.HOLDING}


@EVERY
def test_a_crash_flag_is_cleared_only_when_asked(model, tmp_path):
    with wired(model, tmp_path, "crashed_motor=4") as (arm, _, _):
        arm.katana.identity()
        with pytest.raises(DeviceError, match=r"motor 4 has collided \(status 40\)"):
            arm.reset(arm.body.lower)
    with wired(model, tmp_path, "crashed_motor=4", unblock=True) as (arm, wire, _):
        arm.reset(arm.body.lower)
        go(arm, wire, SLOW, 3)


@EVERY
def test_calibration_happens_only_when_asked(model, tmp_path):
    with wired(model, tmp_path, "uncalibrated") as (arm, wire, _):
        with pytest.raises(DeviceError, match=r"switched off: .*calibrate=true"):
            arm.reset(arm.body.lower)
        assert {motor.doing.name for motor in wire.device.arm.motors} == {"OFF"}
    with wired(model, tmp_path, "uncalibrated", calibrate=True) as (arm, wire, _):
        arm.reset(arm.body.lower)
        assert arm.katana.positions() == pytest.approx(
            [30000, -30000, -30000, 30000, 30000, 30000], abs=100
        )


def test_an_arm_can_be_led_by_hand(tmp_path):
    with wired("400", tmp_path) as (arm, _, _):
        arm.go_limp()
        assert set(arm.katana.statuses()) == {Status.OFF}
        arm.go_stiff()
        assert set(arm.katana.statuses()) == {Status.HOLDING}
