"""How sure a number is."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from imitation.analysis.statistics import bootstrap, rate_is_met, wilson

trials = st.integers(1, 500).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n)))


def median(values) -> float:
    return float(np.median(values))


@pytest.mark.parametrize(
    ("successes", "n", "low", "high"),
    [
        (5, 10, 0.2366, 0.7634),
        (0, 10, 0.0, 0.2775),
        (10, 10, 0.7225, 1.0),
        (95, 100, 0.8882, 0.9785),
    ],
)
def test_wilson_interval_is_the_one_in_the_tables(successes, n, low, high):
    interval = wilson(successes, n)
    assert (interval.low, interval.high) == pytest.approx((low, high), abs=1e-4)


@given(trials)
def test_wilson_interval_holds_the_rate_and_stays_within_0_and_1(trial):
    successes, n = trial
    interval = wilson(successes, n)
    assert 0 <= interval.low <= successes / n <= interval.high <= 1


@given(trials)
def test_wilson_interval_of_failures_mirrors_that_of_successes(trial):
    successes, n = trial
    interval, mirrored = wilson(successes, n), wilson(n - successes, n)
    assert interval.low == pytest.approx(1 - mirrored.high)


@given(trials)
def test_ten_times_the_trials_make_a_narrower_interval(trial):
    successes, n = trial
    few, many = wilson(successes, n), wilson(10 * successes, 10 * n)
    assert many.high - many.low < few.high - few.low


def test_without_trials_nothing_is_known_and_no_rate_is_met():
    assert (wilson(0, 0).low, wilson(0, 0).high) == (0.0, 1.0)
    assert not rate_is_met(0, 0, bound=0.5)


def test_a_rate_is_met_when_its_lower_end_is_above_the_bound_less_three_points():
    assert wilson(190, 200).low == pytest.approx(0.9104, abs=1e-4)
    assert rate_is_met(190, 200, bound=0.94)
    assert not rate_is_met(190, 200, bound=0.9405)


def test_few_trials_do_not_meet_a_high_rate_even_without_a_failure():
    assert not rate_is_met(20, 20, bound=0.95)
    assert rate_is_met(100, 100, bound=0.95)


def test_bootstrap_of_many_equal_groups_is_near_the_textbook_interval_of_the_mean():
    rng = np.random.default_rng(0)
    groups = list(rng.normal(3.0, 1.0, (200, 1)))
    interval = bootstrap(groups, lambda values: float(values.mean()), rng, resamples=1000)
    mean, half = np.mean(groups), 1.96 * np.std(groups) / np.sqrt(200)
    assert (interval.low, interval.high) == pytest.approx((mean - half, mean + half), abs=0.02)


def test_many_trials_on_few_maps_do_not_look_like_many_maps():
    easy, hard = np.ones(1000), np.zeros(1000)
    interval = bootstrap([easy, hard], lambda v: float(v.mean()), np.random.default_rng(0), 200)
    assert (interval.low, interval.high) == (0.0, 1.0)


def test_groups_may_differ_in_size():
    groups = [np.array([1.0, 2.0]), np.array([3.0]), np.array([2.0, 2.0, 2.0])]
    interval = bootstrap(groups, median, np.random.default_rng(0), resamples=200)
    assert 1.0 <= interval.low <= 2.0 <= interval.high <= 3.0


def test_the_same_random_numbers_give_the_same_interval():
    groups = list(np.random.default_rng(1).normal(size=(10, 3)))
    first, second = (bootstrap(groups, median, np.random.default_rng(7), 100) for _ in range(2))
    assert first == second


def test_without_groups_the_interval_is_not_a_number():
    interval = bootstrap([], median, np.random.default_rng(0), resamples=10)
    assert np.isnan([interval.low, interval.high]).all()
