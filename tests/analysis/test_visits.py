"""Visits to areas: which are followed and in which order, made by hand."""

import pytest

from imitation.analysis.visits import Visit, followed_visits, in_order, visits, visits_of
from imitation.visual_field import VisualField

PERIOD = 0.04  # [s]
FIELD = VisualField("right_4x4", (160, 120), 4, 4, 40.0)
A, B, C = (1, 1), (1, 3), (3, 3)


def test_visits_are_stays_in_one_area_after_the_other():
    times = [0.0, 0.04, 0.08, 0.12, 0.16, 0.20]
    areas = [A, A, None, A, B, B]
    found = visits(times, areas, PERIOD)
    assert [visit.area for visit in found] == [A, A, B]
    assert [visit.begin for visit in found] == [0.0, 0.12, 0.16]
    assert [visit.end for visit in found] == pytest.approx([0.08, 0.16, 0.24])


def test_a_visit_is_followed_during_it_or_shortly_after():
    shown = [Visit(A, 1.0, 2.0)]
    assert followed_visits(shown, [Visit(A, 2.4, 3.0)], 0.5) == shown
    assert followed_visits(shown, [Visit(A, 2.6, 3.0)], 0.5) == []
    assert followed_visits(shown, [Visit(A, 0.0, 0.9)], 0.5) == []
    assert followed_visits(shown, [Visit(B, 1.2, 3.0)], 0.5) == []


def test_a_stay_since_before_follows_too():
    shown = [Visit(A, 1.0, 2.0)]
    assert followed_visits(shown, [Visit(A, 0.0, 1.5)], 0.5) == shown


def test_each_own_visit_is_used_once_and_in_order():
    shown = [Visit(A, 0, 1), Visit(B, 1, 2), Visit(A, 2, 3)]
    assert followed_visits(shown, [Visit(A, 0, 3)], 0.5) == shown[:1]
    own = [Visit(A, 0.5, 1.2), Visit(B, 1.5, 2.2), Visit(A, 2.5, 3)]
    assert followed_visits(shown, own, 0.5) == shown
    assert followed_visits(shown[:2], own[1::-1], 0.5) == [shown[0]]


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
