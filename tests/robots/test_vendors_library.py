"""What the vendor's library does with an arm, done with the emulated one over its real line."""

import pytest
from vendors_library import at_work

MODELS = ("300", "400", "450")
BENT = (3000, -16000, -18000, 12000, 18000, 25000)


@pytest.mark.parametrize("model", MODELS)
def test_it_starts_as_ros_starts_it_and_is_told_all_it_asks(model, tmp_path):
    with at_work(model, tmp_path) as arm:
        arm.connect()
        arm.hello()
        arm.start_as_ros_does()
        arm.limits()
        assert len(arm.sensors()) == 16
        arm.limit_crashes(False)


@pytest.mark.parametrize("model", MODELS)
def test_it_calibrates_then_moves_one_by_one_all_at_once_and_the_gripper(model, tmp_path):
    with at_work(model, tmp_path) as arm:
        arm.connect()
        arm.calibrate()
        arm.until(lambda: [abs(one) for one in arm.positions()] == [30000] * 6)
        arm.move({1: 7500})
        arm.move_all(BENT)
        arm.move({6: arm.model.closed})
        arm.move({6: arm.model.opened})


@pytest.mark.parametrize("model", MODELS)
def test_it_lets_motors_follow_splines_and_sees_when_they_have(model, tmp_path):
    with at_work(model, tmp_path) as arm:
        arm.connect()
        arm.spline({1: 29000, 2: -29000, 5: 29500}, ticks=40)
        arm.spline({1: 28000, 2: -28000, 5: 29000}, ticks=40)
        if arm.model.moves_all:
            arm.splines_of_all(BENT, ticks=150)


@pytest.mark.parametrize("model", MODELS)
def test_it_freezes_switches_off_and_on_and_moves_again(model, tmp_path):
    with at_work(model, tmp_path) as arm:
        arm.connect()
        arm.control(1, 24, 0)
        arm.unblock()
        stopped = arm.positions()
        arm.unblock(0)
        assert [arm.motor(number)[0] for number in range(1, 7)] == [0] * 6
        arm.unblock()
        assert arm.positions() == stopped
        arm.move({1: 29000})


@pytest.mark.parametrize("model", ["400", "450"])
def test_it_learns_why_a_request_was_refused_and_uses_the_digital_ports(model, tmp_path):
    with at_work(model, tmp_path) as arm:
        arm.connect()
        report = arm.error_report()
        assert (len(report), report[:4]) == (57, b"\xc1D\xfe\x00")
        arm.digital()
