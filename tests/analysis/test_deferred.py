"""What is said of a replay, on paths made by hand."""

import numpy as np
import pytest

from imitation.analysis.deferred import (
    acts_done,
    all_in_order,
    carried,
)


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
