"""A real arm is led to where an episode begins, and parks when it is asked to."""

import numpy as np
import pytest
from on_bench import bench

from imitation.approach import Approach
from imitation.device import DeviceError
from imitation.robot import Command, Robot

PERIOD_NS = 4_000_000


def led(park: bool, patience: float = 3.0) -> tuple[Robot, np.ndarray]:
    """A robot that is led as a real one, and where it rests."""
    parts = bench("learn-map", "robot=ideal")
    how = Approach(share=1.0, tolerance=0.02, patience=patience, park=park)
    home, guard = parts.guided.mean(axis=0), parts.guard(parts.arm.body)
    return Robot(parts.arm, parts.camera, guard, home, PERIOD_NS, how), home + 0.2


@pytest.mark.parametrize("park", [True, False])
def test_an_arm_parks_if_it_should_and_else_stays(park):
    robot, rest = led(park)
    robot.reset()
    robot.step(Command(np.full(5, 0.1)))
    stands = robot.arm.read().posture
    robot.park(rest)
    assert robot.arm.read().posture == pytest.approx(rest if park else stands, abs=0.02)
    assert not robot.leading


def test_an_arm_that_cannot_be_led_is_told_after_a_while_and_is_led_no_more():
    robot, rest = led(park=True, patience=0.1)
    robot.reset()
    robot.arm.move = lambda velocity, grip, period: velocity
    with pytest.raises(DeviceError, match="no nearer"):
        robot.park(rest)
    assert not robot.leading
