"""A frame is paired with the posture the arm had when it was captured."""

import numpy as np
import pytest

from imitation.pairing import PostureHistory

PERIOD = 40_000_000  # [ns]


def history(steps: int, span: float = 2.0) -> PostureHistory:
    """Postures noted at each step; the only joint's angle is the step's number."""
    noted = PostureHistory(span)
    for step in range(steps):
        noted.note(step * PERIOD, np.array([float(step)]))
    return noted


@pytest.mark.parametrize("step", [0, 4, 9])
def test_a_frame_gets_the_posture_sensed_at_its_time(step):
    assert history(10).at(step * PERIOD) == step


@pytest.mark.parametrize(("late", "nearest"), [(0.4, 3), (0.6, 4), (0.99, 4)])
def test_between_two_sensings_the_nearer_one_counts(late, nearest):
    assert history(10).at(round((3 + late) * PERIOD)) == nearest


def test_a_frame_newer_than_all_gets_the_last_posture():
    assert history(10).at(50 * PERIOD) == 9


def test_a_frame_older_than_all_gets_the_oldest_posture_still_known():
    assert history(100, span=0.2).at(0) == 94  # 0.2 s are 5 steps before the last


def test_no_more_than_the_span_is_kept():
    noted = history(100_000, span=0.4)
    assert noted.at(0) == 99_999 - 10
    assert noted.at(99_995 * PERIOD) == 99_995
