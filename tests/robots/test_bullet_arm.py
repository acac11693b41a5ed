"""The simulated arm where no guard stands before it."""

import numpy as np
import pytest
from on_bench import bench

from imitation.robots.bullet.world import pybullet

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


STRETCHED = {  # where the weight of what follows pulls most at a joint [rad]
    "katana_sim": [0.0, 1.6, 0.0, 0.0, 0.0],
    "so101_sim": [-1.295, 1.737, -1.438, -0.61, -1.213],
}


@pytest.mark.parametrize("body", STRETCHED)
def test_while_one_joint_moves_the_others_do_not_sag(body):
    arm, start = bench("learn-map", f"robot={body}").robot.arm, np.array(STRETCHED[body])
    arm.reset(start)
    last_joint_alone = 0.1 * np.eye(len(start))[-1]
    for _ in range(50):
        arm.move(last_joint_alone, None, 0.04)
    away = arm.read().posture - start
    arm.close()
    assert (np.abs(away[:-1]) < 0.02).all()
    assert 0.19 <= away[-1] <= 0.21


def test_a_jaw_that_nothing_drives_stays_closed():
    arm = bench("learn-map", "robot=so101_sim").robot.arm
    arm.reset(np.array([0.0, -0.5, 0.5, 0.5, 0.0]))
    for step in range(150):
        shaken = 1.2 * np.sign(np.sin(step / 3 + np.arange(5)))
        arm.move(shaken, None, 0.04)
    jaw, *_ = pybullet.getJointState(arm.world._arm, 5, physicsClientId=arm.world._client)
    arm.close()
    assert jaw == pytest.approx(0.0, abs=0.01)
