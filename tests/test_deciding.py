"""How a decision is slowed to what the arm can do."""

import numpy as np

from imitation.deciding import at_own_pace, drawn_by, one_attractor
from imitation.dynamics import Dynamics

ACCELERATION = np.array([2.5, 1.3, 1.3])
LOWER = np.full(3, -2.0)
GOAL = np.array([0.2, -0.3, 0.15])


def steps_to(goal, turning):
    """Postures on the way to `goal`, and the largest change of speed, in what the arm can do."""
    posture, before, period = np.zeros(3), np.zeros(3), 0.04
    dynamics = Dynamics(LOWER, -LOWER, tau=0.1, beta=2.0)
    way, hardest = [posture], 0.0
    while np.abs(goal - posture).max() > 1e-3:
        decision = drawn_by(one_attractor(goal), None, posture, dynamics, 1.0, 0.0)
        slowed = at_own_pace(decision, posture, before, ACCELERATION, period, turning).velocity
        hardest = max(hardest, float((np.abs(slowed - before) / ACCELERATION / period).max()))
        posture, before = posture + slowed * period, slowed
        way.append(posture)
    return np.array(way), hardest


def test_joints_that_turn_the_arm_need_not_wait_and_the_others_keep_to_their_line():
    together, _ = steps_to(GOAL, 0)
    apart, _ = steps_to(GOAL, 1)
    arrived = [int(np.argmax(np.abs(way[:, 0] - GOAL[0]) < 0.01)) for way in (together, apart)]
    assert arrived[1] < arrived[0] - 5
    np.testing.assert_allclose(apart[:, 1] * GOAL[2], apart[:, 2] * GOAL[1], atol=1e-6)
    np.testing.assert_allclose(apart[-1], GOAL, atol=2e-3)


def test_nothing_is_asked_that_the_arm_cannot_do():
    for turning in (0, 1, 3, 7):
        assert steps_to(GOAL, turning)[1] <= 1 + 1e-9
