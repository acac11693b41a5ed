"""What is said of a replay, on paths made by hand."""

import numpy as np
import pytest

from imitation.analysis.deferred import (
    acts_done,
    all_in_order,
    carried,
    in_order,
    visits_of,
)
from imitation.analysis.visits import Visit
from imitation.visual_field import VisualField

FIELD = VisualField("right_4x4", (160, 120), 4, 4, 40.0)
A, B, C = (1, 1), (1, 3), (3, 3)


def stays(*areas_and_seconds) -> list[Visit]:
    """Visits one after the other, a second apart."""
    found, time = [], 0.0
    for area, seconds in areas_and_seconds:
        found.append(Visit(area, time, time + seconds))
        time += seconds + 1.0
    return found


def test_a_path_through_all_states_in_order_is_correct():
    order = in_order(stays((A, 1.0), (B, 1.0), (C, 1.0)), [A, B, C])
    assert order.correct
    assert order.entries == (0.0, 2.0, 4.0)


def test_states_in_another_order_are_not_correct():
    assert not in_order(stays((B, 1.0), (A, 1.0), (C, 1.0)), [A, B, C]).correct


def test_a_state_that_is_missing_is_not_correct():
    order = in_order(stays((A, 1.0), (B, 1.0)), [A, B, C])
    assert not order.correct
    assert len(order.entries) == 2


@pytest.mark.parametrize(("seconds", "correct"), [(0.2, True), (0.4, False)])
def test_another_state_may_be_crossed_only_shortly(seconds, correct):
    assert in_order(stays((A, 1.0), (C, seconds), (B, 1.0), (C, 1.0)), [A, B, C]).correct is correct


def test_an_area_left_and_entered_again_is_one_entry():
    order = in_order(stays((A, 1.0), (A, 1.0), (B, 1.0)), [A, B])
    assert order.correct
    assert order.entries == (0.0, 4.0)


def test_visits_are_the_stays_in_areas_of_the_action_alone():
    centres = [FIELD.centres[area] for area in (A, A, (2, 2), B, B, B)]
    found = visits_of([0.0, 0.1, 0.2, 0.3, 0.4, 0.5], centres, [A, B], FIELD)
    assert found == [Visit(A, 0.0, 0.1), Visit(B, 0.3, 0.5)]


def moved(*, hand: float, thing: float, touching: bool = True) -> bool:
    """Whether a thing is carried that moves `thing` m while the hand moves `hand` m in 2 s."""
    times = np.arange(50) * 0.04
    along = np.array([1.0, 0.0, 0.0])
    hands, things = (times[:, None] / 2 * far * along for far in (hand, thing))
    return carried(times, [touching] * 50, hands, things)


def test_a_thing_is_grasped_when_it_moves_with_the_hand_that_touches_it():
    assert moved(hand=0.2, thing=0.2)


def test_a_thing_that_lags_is_not_touched_or_does_not_move_is_not_grasped():
    assert not moved(hand=0.2, thing=0.1)
    assert not moved(hand=0.2, thing=0.2, touching=False)
    assert not moved(hand=0.0, thing=0.0)


def scored(**changes) -> dict:
    """Metrics of a replay that did everything, but for `changes`."""
    whole = {"states_asked": 3, "states_replayed": 3, "grasped": True, "object_error_m": 0.01}
    return {**whole, "order_correct": True, **changes}


def test_target_acts_are_the_states_the_grasp_and_the_putting_down():
    assert acts_done(scored()) == 1.0
    assert acts_done(scored(grasped=False)) == pytest.approx(0.8)
    assert acts_done(scored(object_error_m=0.05)) == pytest.approx(0.8)
    assert acts_done(scored(object_error_m=None, grasped=False, states_replayed=0)) == 0.0


def test_all_acts_in_another_order_are_not_all_in_order():
    assert all_in_order(scored())
    assert not all_in_order(scored(order_correct=False))
    assert not all_in_order(scored(grasped=False))
