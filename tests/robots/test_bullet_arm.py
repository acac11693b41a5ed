"""The simulated arm where no guard stands before it."""

import numpy as np
from on_bench import bench

PRESSING = np.array([0.0, -0.5, 0.0, 0.0, 0.0])  # the shoulder's lift, down onto the table [rad/s]


def test_an_arm_that_was_blocked_makes_up_for_nothing_when_it_is_free_again():
    parts = bench("learn-map")
    arm = parts.robot.arm
    arm.reset(parts.guided.mean(axis=0))
    for _ in range(50):
        arm.move(PRESSING, None, 0.04)
    blocked = arm.read().posture
    for _ in range(10):
        arm.move(-PRESSING, None, 0.04)
        assert (np.abs(arm.read().velocity) <= 1.05 * arm.body.speed).all()
    risen = (arm.read().posture - blocked)[1]
    arm.close()
    assert 0.15 <= risen <= 0.2  # 0.4 s at 0.5 rad/s
