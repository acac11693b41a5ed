"""The Katana's driver against emulated arms over TCP and a serial port."""

import time

import numpy as np
import pytest
from emulated import driven, katana_device, served

from imitation.device import DeviceError
from imitation.robots.katana import commands
from imitation.robots.katana.calibration import calibrate
from imitation.robots.katana.driver import Katana, connect
from imitation.robots.katana.models import MODELS

READY = [30000, -30000, -30000, 30000, 30000, 30000]
EVERY = pytest.mark.parametrize("model", MODELS)


@EVERY
def test_an_arm_says_who_and_where_it_is(model, tmp_path):
    with driven(katana_device(model), tmp_path) as arm:
        identity = arm.identity()
        assert identity.firmware[0] in arm.model.firmware
        assert model in identity.text
        assert identity.motors == ((2, 1),) * 6
        assert arm.positions().tolist() == READY
        assert arm.statuses() == (8,) * 6
        assert len(arm.sensors()) == 16


def test_another_model_than_the_one_asked_for_is_refused(tmp_path):
    with served(katana_device("450")) as where:
        arm = Katana(connect(MODELS["400"], where, 0.1, 4), MODELS["400"])
        with pytest.raises(DeviceError, match=r"firmware 2.1 .*Katana 400 has 0.x or 1.x"):
            arm.identity()
        arm.close()


@EVERY
def test_motors_go_where_they_are_sent(model, tmp_path):
    with driven(katana_device(model), tmp_path) as arm:
        targets = np.array(READY) * 0.9
        arm.set_limits([60] * 6, 2)
        for motor, target in enumerate(targets.astype(int), 1):
            arm.move(motor, int(target))
        arm.wait_until_near(targets, tolerance=1.0, limit=5.0)


@pytest.mark.parametrize("model", ["400", "450"])
def test_segments_for_all_motors_end_on_their_targets_one_after_the_other(model, tmp_path):
    with driven(katana_device(model), tmp_path) as arm:
        at = np.array(READY)
        for _ in range(3):
            arm.move_all(commands.as_segments(at, at * 0.99, ticks=12))
            at = (at * 0.99).astype(int)
        arm.wait_until_near(at, tolerance=1.0, limit=2.0)
        assert set(arm.statuses()) == {commands.Status.SPLINE_DONE}


@EVERY
def test_a_target_beyond_a_motors_range_is_never_sent(model, tmp_path):
    with (
        driven(katana_device(model), tmp_path) as arm,
        pytest.raises(DeviceError, match="motor 2 was to go to 20000"),
    ):
        arm.move(2, 20000)


@EVERY
def test_freezing_stops_every_motor_where_it_is(model, tmp_path):
    with driven(katana_device(model, speed=1.0), tmp_path) as arm:
        arm.move(1, 0)
        arm.freeze()
        before = arm.positions()
        assert arm.statuses() == (8,) * 6
        assert before[0] == pytest.approx(30000, abs=200)
        assert arm.positions().tolist() == before.tolist()


@EVERY
def test_switched_off_motors_say_so_and_stay_off_until_asked(model, tmp_path):
    with driven(katana_device(model), tmp_path) as arm:
        arm.switch_off()
        assert arm.statuses() == (0,) * 6
        arm.unblock()
        assert arm.statuses() == (8,) * 6


@EVERY
def test_a_crashed_motor_moves_again_only_after_it_was_unblocked(model, tmp_path):
    with driven(katana_device(model, "crashed_motor=3"), tmp_path) as arm:
        arm.identity()
        assert arm.statuses()[2] == commands.Status.CRASHED
        with pytest.raises(DeviceError, match="motor 3"):
            arm.move(3, -29000)
        arm.unblock()
        arm.move(3, -29000)
        arm.wait_until_near(np.array([*READY[:2], -29000, *READY[3:]]), 1.0, 2.0)


@EVERY
def test_an_arm_that_was_just_switched_on_knows_where_it_is_after_calibration(model, tmp_path):
    device = katana_device(model, "uncalibrated", speed=500.0)
    with driven(device, tmp_path) as arm:
        arm.sleep = lambda seconds: time.sleep(seconds / 50)
        assert arm.positions().tolist() == [0] * 6
        calibrate(arm, limit=5.0)
        assert arm.positions() == pytest.approx(np.array(READY), abs=100)
        assert [motor.shift for motor in device.arm.motors] == pytest.approx([0] * 6, abs=100)


@pytest.mark.parametrize("fault", ["wrong_crc@0x3", "silence@0x3", "split", "late@0x1"])
def test_what_a_line_does_to_a_reply_for_a_while_is_survived(fault, tmp_path):
    with driven(katana_device("400", fault), tmp_path) as arm:
        for _ in range(3):
            assert arm.positions().tolist() == READY
            assert arm.statuses() == (8,) * 6
            assert arm.motor(2).position == READY[1]


@pytest.mark.parametrize("model", ["300", "400"])
@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ("wrong_crc", "wrong CRC"),
        ("silence", "0 bytes came"),
    ],
)
def test_a_line_that_does_not_recover_ends_in_one_sentence(model, fault, told, tmp_path):
    with (
        driven(katana_device(model, fault), tmp_path) as arm,
        pytest.raises(DeviceError, match=f"4 times in vain: .*{told}"),
    ):
        arm.positions()


@pytest.mark.parametrize("model", ["300", "400"])
def test_a_cut_line_is_told_at_once(model, tmp_path):
    with driven(katana_device(model, "cut"), tmp_path) as arm, pytest.raises(DeviceError):
        for _ in range(5):
            arm.positions()


def test_nobody_at_the_other_end_is_told_with_the_address():
    with pytest.raises(DeviceError, match=r"nothing answers at 127.0.0.1:1 "):
        connect(MODELS["400"], "127.0.0.1:1", 0.1, 4)


def test_a_serial_port_that_is_not_there_is_told_with_its_name(tmp_path):
    with pytest.raises(DeviceError, match=r"serial port .*nowhere cannot be opened"):
        connect(MODELS["300"], str(tmp_path / "nowhere"), 0.1, 4)


@pytest.mark.parametrize("address", ["", ":5566", "arm:", "arm:0", "arm:99999", "arm:80x", "a:1:2"])
def test_what_is_no_address_is_refused_before_anybody_is_looked_for(address):
    with pytest.raises(ValueError, match=f"robot.arm.address={address} is no HOST or HOST:PORT"):
        connect(MODELS["400"], address, 0.1, 4)
