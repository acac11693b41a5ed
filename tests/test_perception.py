"""Where the hand is seen when more than one thing looks like it."""

from dataclasses import dataclass

import numpy as np
import pytest

from imitation.arrays import Array
from imitation.gaze import VisualSpace
from imitation.perception import Perception
from imitation.robot import Observation
from imitation.visual_field import VisualField

FIELD = VisualField("right_4x4", (160, 120), 4, 4, 40.0)
SPACE = VisualSpace((160, 120), 500.0, (80.0, 60.0), (0.0, 0.0))


@dataclass(frozen=True)
class These:
    """Finds the same pixels in whatever is seen."""

    pixels: Array

    def hand_in(self, seen: Observation) -> Array:
        return self.pixels


def hand_seen(*patches: tuple[float, float, int], attended=None) -> Array | None:
    """Where the hand is seen when each patch is so many pixels at a place x, y."""
    spread = [
        np.random.default_rng(0).uniform(-5, 5, (count, 2)) + np.array((x, y))
        for x, y, count in patches
    ]
    nothing = np.zeros(2)
    seen = Observation(
        0, nothing, nothing, nothing, np.zeros((120, 160, 3), np.uint8), 0, nothing, nothing,
        1.0, np.inf, False, begins=True,
    )  # fmt: skip
    pixels = np.concatenate([np.empty((0, 2)), *spread])
    return Perception(These(pixels), SPACE, FIELD).perceive(seen, attended).hand


def test_of_two_hands_the_one_counts_that_shows_more_in_an_area():
    assert hand_seen((55, 45, 100), (145, 105, 60)) == pytest.approx((55, 45), abs=1)


def test_a_hand_on_a_border_is_seen_whole():
    assert hand_seen((70, 60, 100)) == pytest.approx((70, 60), abs=1)


def test_where_attention_is_drawn_the_weaker_hand_counts():
    attended = FIELD.around((3, 4))
    assert hand_seen((55, 45, 100), (145, 105, 60), attended=attended) == pytest.approx(
        (145, 105), abs=1
    )


def test_no_hand_is_nowhere():
    assert hand_seen() is None
