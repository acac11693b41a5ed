"""How well one path follows another, on paths made by hand."""

import numpy as np
import pytest

from imitation.analysis.mimicry import (
    correlation,
    dtw,
    evenly,
    frechet,
    jitter,
    lag_steps,
    lag_taken_out,
    rmse,
)

PERIOD = 0.04  # [s]
TIMES = np.arange(0, 12, PERIOD)


def circle(times, radius=30.0):
    phase = np.pi / 2 * times  # a period of 4 s
    return np.column_stack((100 + radius * np.cos(phase), 60 + radius * np.sin(phase)))


def line(times):
    return np.column_stack((80 + 10 * times, np.full(len(times), 45.0)))


def moved(path, x, y):
    return path + np.array((x, y))


def test_a_path_that_comes_later_has_that_lag_and_no_error_after_it():
    shown, followed = circle(TIMES), circle(TIMES - 7 * PERIOD)
    lag = lag_steps(shown, followed, 50)
    assert lag == 7
    assert rmse(*lag_taken_out(shown, followed, lag)) == pytest.approx(0, abs=1e-9)
    assert rmse(shown, followed) > 10


def test_an_offset_is_no_lag():
    shown = circle(TIMES)
    assert lag_steps(shown, moved(shown, 3, 4), 50) == 0
    assert rmse(shown, moved(shown, 3, 4)) == pytest.approx(5)


def test_the_lag_never_exceeds_its_bound():
    assert lag_steps(line(TIMES), line(TIMES - 40 * PERIOD), 10) == 10


def test_the_correlation_is_defined_on_a_straight_line():
    assert correlation(line(TIMES), moved(line(TIMES), 0, 20)) == pytest.approx(1)
    assert correlation(line(TIMES), line(TIMES)[::-1]) == pytest.approx(-1)


def test_a_circle_a_quarter_behind_is_not_correlated():
    assert correlation(circle(TIMES), circle(TIMES - 1.0)) == pytest.approx(0, abs=0.01)


def test_a_path_that_keeps_still_has_no_correlation():
    assert np.isnan(correlation(circle(TIMES), np.full((len(TIMES), 2), 50.0)))


def test_samples_at_which_nothing_was_seen_do_not_count():
    shown, followed = circle(TIMES), moved(circle(TIMES), 3, 4)
    followed[::3] = np.nan
    assert rmse(shown, followed) == pytest.approx(5)
    assert correlation(shown, followed) == pytest.approx(1, abs=1e-3)
    assert np.isfinite([dtw(shown, followed), frechet(shown, followed, 100)]).all()


def test_nothing_seen_at_all_has_no_numbers():
    shown, unseen = circle(TIMES), np.full((len(TIMES), 2), np.nan)
    for number in (rmse(shown, unseen), correlation(shown, unseen), dtw(shown, unseen)):
        assert np.isnan(number)
    assert lag_steps(shown, unseen, 10) == 0


def test_warping_takes_out_time_but_not_place():
    slowly = line(TIMES)
    hurrying = line(12 * (TIMES / 12) ** 2)  # the same places at other times
    assert dtw(slowly, hurrying) < 0.3
    assert dtw(slowly, moved(slowly, 0, 5)) == pytest.approx(5, abs=0.01)


def test_warping_does_not_grow_with_the_length_of_the_paths():
    once, often = line(TIMES[:100]), line(TIMES)
    assert dtw(once, moved(once, 0, 5)) == pytest.approx(dtw(often, moved(often, 0, 5)), abs=0.01)


def test_the_frechet_distance_is_the_farthest_that_cannot_be_helped():
    straight = line(TIMES)
    bulging = straight + np.column_stack((np.zeros(len(TIMES)), 8 * np.sin(TIMES / 12 * np.pi)))
    assert frechet(straight, bulging, 200) == pytest.approx(8, abs=0.2)


def test_the_frechet_distance_does_not_see_speed():
    assert frechet(line(TIMES), line(12 * (TIMES / 12) ** 2), 200) < 0.8


def test_a_path_is_resampled_evenly_along_its_length():
    corner = np.array([[0, 0], [30, 0], [30, 10]], dtype=float)
    assert evenly(corner, 5) == pytest.approx(
        np.array([[0, 0], [10, 0], [20, 0], [30, 0], [30, 10]])
    )


@pytest.mark.parametrize(("frequency", "within"), [(1.0, False), (2.5, True), (4.0, False)])
def test_jitter_is_what_swings_two_to_three_times_a_second(frequency, within):
    swing = np.column_stack((2 * np.sin(2 * np.pi * frequency * TIMES), np.zeros(len(TIMES))))
    found = jitter(swing + 50, PERIOD, 2.0, 3.0)
    assert found == pytest.approx(2 / np.sqrt(2) if within else 0, abs=0.02)
