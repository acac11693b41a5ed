"""When the gripper closes by itself, and when a grasp is firm."""

import pytest

from imitation.grasp import CLOSED, OPEN, GraspReflex, Hand

NOTHING = float("inf")  # between the fingers


def reflex() -> GraspReflex:
    return GraspReflex(close_within=0.02, firm=0.2, closing=1.2, opening=0.6)


def grasping() -> GraspReflex:
    """A reflex that began to close at time 0."""
    one = reflex()
    assert one.feel(0.0, 0.015, False, arrived=False) == CLOSED
    return one


def test_it_stays_open_over_nothing():
    one = reflex()
    assert one.feel(0.0, NOTHING, False, arrived=True) is None
    assert one.hand is Hand.EMPTY


@pytest.mark.parametrize(
    ("proximity", "arrived", "closes"),
    [(0.015, False, True), (0.05, False, False), (0.05, True, True), (NOTHING, True, False)],
)
def test_it_closes_on_what_is_near_and_on_arrival_on_what_is_between_the_fingers(
    proximity, arrived, closes
):
    one = reflex()
    assert (one.feel(0.0, proximity, False, arrived) == CLOSED) is closes
    assert (one.hand is Hand.CLOSING) is closes


def test_a_grasp_is_firm_when_both_fingers_have_touched_for_a_while():
    one = grasping()
    for step, touching in enumerate((False, True, False, True, True, True)):
        one.feel(0.1 * (step + 1), 0.015, touching, arrived=False)
    assert one.hand is Hand.HOLDING


def test_a_touch_that_is_lost_does_not_count():
    one = grasping()
    for step in range(10):
        one.feel(0.1 * (step + 1), 0.015, step % 2 == 0, arrived=False)
    assert one.hand is Hand.CLOSING


@pytest.mark.parametrize(("touching", "ends"), [(False, Hand.MISSED), (True, Hand.HOLDING)])
def test_closing_ends_and_tells_whether_anything_is_held(touching, ends):
    one = grasping()
    one.feel(1.3, NOTHING, touching, arrived=False)
    assert one.hand is ends
    assert one.shut


def test_what_was_let_go_is_grasped_again_only_after_it_was_out_of_reach():
    one = grasping()
    one.feel(1.3, 0.015, True, arrived=True)
    assert one.release(2.0) == OPEN
    assert one.feel(2.3, 0.015, False, arrived=True) is None
    assert one.hand is Hand.OPENING
    assert one.feel(2.7, 0.015, False, arrived=True) is None
    assert one.feel(2.8, 0.015, False, arrived=True) is None
    assert one.hand is Hand.EMPTY
    assert one.feel(2.9, NOTHING, False, arrived=True) is None
    assert one.feel(3.0, 0.015, False, arrived=True) == CLOSED
