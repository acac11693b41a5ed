"""The mirror experiment in numbers, on paths made by hand."""

import numpy as np
import pytest

from imitation.analysis.mirror import Aside, aside, corrects_against, follows, grows

AGAINST = [Aside(0, 0.3, -0.2), Aside(5, -6, 4.8), Aside(10, -14, 9.9)]


def test_how_far_aside_is_a_mean_about_a_time():
    times = np.arange(0, 4, 0.04)
    places = np.column_stack((100 + np.where(times > 2, 8.0, 0.0), 95 - 10 * times))
    to_the_right = np.array([1.0, 0.0])
    late, early = (aside(times, places, to_the_right, at, 0.2) for at in (3.0, 1.0))
    assert late - early == pytest.approx(8)


def test_a_correction_goes_to_the_other_side_and_grows():
    assert corrects_against(AGAINST)
    assert grows(AGAINST)
    assert follows(AGAINST)


def test_one_deviation_that_is_followed_is_no_correction():
    assert not corrects_against([*AGAINST, Aside(20, 3, 20)])


def test_a_larger_deviation_that_moves_the_arm_less_does_not_grow():
    assert not grows([*AGAINST, Aside(20, -12, 20)])


def test_an_arm_that_stays_does_not_follow():
    assert not follows([*AGAINST, Aside(20, -20, -0.1)])
