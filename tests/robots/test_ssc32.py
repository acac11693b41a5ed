"""The neck: an SSC-32 on a serial port, emulated."""

import time
from contextlib import contextmanager

import numpy as np
import pytest
from emulated import served

from imitation.device import DeviceError
from imitation.robots.faults import Faults, read_fault
from imitation.robots.serial_line import SerialLine
from imitation.robots.ssc32 import Servo, Ssc32Neck
from imitation.robots.ssc32_emulator import FAULTS, Ssc32Emulator

PAN, TILT = Servo(0, 1500, 636.6, 1000, 2000), Servo(1, 1500, -636.6, 1200, 1800)
STRAIGHT = np.array([-0.14, -1.09])
LEFT, LEFT_AND_UP = np.array([0.2, 0.0]), np.array([0.2, 0.1])


def board(*faults: str) -> Ssc32Emulator:
    return Ssc32Emulator(Faults([read_fault(one, FAULTS) for one in faults]))


@contextmanager
def neck(device, folder, speed=50.0, watch=0.0):
    with served(device, folder / "neck") as where:
        line = SerialLine(where, 115200, 0.2)
        try:
            yield Ssc32Neck(line, (PAN, TILT), STRAIGHT, speed, 0.2, watch)
        finally:
            line.close()


def until(true) -> bool:
    end = time.monotonic() + 1.0
    while time.monotonic() < end and not true():
        time.sleep(0.005)
    return true()


def test_the_neck_wakes_looking_straight_and_only_then(tmp_path):
    device = board()
    with neck(device, tmp_path) as one:
        assert device.pulses() == {}
        one.wake()
        assert until(lambda: device.pulses() == {0: 1500, 1: 1500})
        assert one.gaze(0.0) == pytest.approx(STRAIGHT)


def test_both_servos_turn_together_and_the_gaze_told_is_the_pulses(tmp_path):
    device = board()
    with neck(device, tmp_path) as one:
        one.wake()
        one.turn(STRAIGHT + LEFT_AND_UP)
        assert until(lambda: device.pulses() == {0: 1627, 1: 1436})
        assert until(lambda: one.gaze(0.0) == pytest.approx(STRAIGHT + LEFT_AND_UP, abs=0.001))


def test_a_turn_takes_the_time_that_its_speed_asks_for(tmp_path):
    with neck(board(), tmp_path, speed=1.0) as one:
        one.wake()
        one.turn(STRAIGHT + LEFT)
        soon = one.gaze(0.0)[0] - STRAIGHT[0]
        assert 0 <= soon < 0.1
        assert one.gaze(-0.1)[0] - STRAIGHT[0] == pytest.approx(soon + 0.1, abs=0.02)


@pytest.mark.parametrize(
    ("hostile", "held"),
    [
        (9.0, {0: 2000, 1: 1200}),
        (-1e300, {0: 1000, 1: 1800}),
        (np.nan, {0: 1500, 1: 1500}),
        (np.inf, {0: 1500, 1: 1500}),
    ],
)
def test_no_pulse_leaves_what_the_mount_bears(tmp_path, hostile, held):
    device = board()
    with neck(device, tmp_path, speed=1e300) as one:
        one.wake()
        one.turn(np.full(2, hostile))
        assert until(lambda: device.pulses() == held)


def test_a_silent_board_is_told_in_one_sentence(tmp_path):
    told = pytest.raises(DeviceError, match=r"neck at .* is silent after VER")
    with told, neck(board("silence"), tmp_path):
        pass


def test_a_board_that_falls_silent_later_is_noticed(tmp_path):
    with neck(board("silence@0.05"), tmp_path) as one:
        one.wake()
        time.sleep(0.1)
        with pytest.raises(DeviceError, match="silent after QP0QP1"):
            one.check()


def test_a_board_that_has_forgotten_its_servos_is_noticed(tmp_path):
    with neck(board("reset@0.05"), tmp_path) as one:
        one.wake()
        time.sleep(0.1)
        with pytest.raises(DeviceError, match="channel 0 should be at 1500 us and is at 0"):
            one.check()


def test_something_else_on_the_line_is_no_board(tmp_path):
    class Parrot:
        faults = Faults()

        def heard(self, data):
            return [data]

        def pass_time(self):
            return 0.0

    told = pytest.raises(DeviceError, match="no SSC-32")
    with told, neck(Parrot(), tmp_path):
        pass


def says(device, text: str) -> bytes:
    return b"".join(device.heard(text.encode()))


def moved(clock=lambda: 0.0) -> Ssc32Emulator:
    return Ssc32Emulator(clock=clock)


def test_nothing_happens_before_the_end_of_a_line_and_escape_cancels_it():
    device = moved()
    assert says(device, "VE") == b""
    assert says(device, "R\r") == b"SSC32-V2.50USB\r"
    says(device, "#0P1500\x1b\r")
    assert device.pulses() == {}


def test_the_first_move_of_a_channel_jumps_and_the_next_takes_its_time():
    now = [0.0]
    device = moved(lambda: now[0])
    says(device, "#5P1000T1000\r")
    assert says(device, "QP5\r") == bytes((100,))
    says(device, "#5 p1500 T1000\r\n")
    now[0] = 0.5
    assert says(device, "Q\r") == b"+"
    assert says(device, "QP5\r") == bytes((125,))
    now[0] = 1.0
    assert says(device, "Q\r") == b"."
    assert device.pulses() == {5: 1500}


def test_a_group_lasts_as_long_as_its_slowest_servo():
    now = [0.0]
    device = moved(lambda: now[0])
    says(device, "#5P1600#10P750\r#17P2000#2P1000\r")
    says(device, "#5P1600#17P750S500#2P2250T2000\r")
    now[0] = 2.4
    assert says(device, "Q\r") == b"+"
    now[0] = 2.5
    assert says(device, "Q\r") == b"."


def test_a_pulse_out_of_range_is_clamped_and_nonsense_is_ignored_without_a_sign():
    device = moved()
    assert says(device, "#0P100\r#1P3000\r#40P1500\rhello\r#2X5\r") == b""
    assert device.pulses() == {0: 500, 1: 2500}


def test_a_stopped_servo_stays_where_it_is():
    now = [0.0]
    device = moved(lambda: now[0])
    says(device, "#3P1000\r#3P2000T1000\r")
    now[0] = 0.25
    says(device, "STOP3\r")
    now[0] = 2.0
    assert device.pulses() == {3: 1250}
