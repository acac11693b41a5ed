"""Visits to areas, and which are followed, made by hand."""

import pytest

from imitation.analysis.visits import Visit, followed_visits, visits

PERIOD = 0.04  # [s]
A, B = (0, 1), (0, 2)


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
