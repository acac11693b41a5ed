"""Frames as JPEG."""

import cv2
import numpy as np
import pytest

from imitation.jpeg import decoded, encoded

GREY, RED = (140, 155, 160), (10, 10, 220)  # blue, green, red, as OpenCV has them


@pytest.mark.parametrize(("left", "top"), [(40, 30), (41, 30), (40, 31), (41, 31)])
def test_a_small_red_tag_is_where_it_was(left, top):
    picture = np.full((120, 160, 3), GREY, np.uint8)
    picture[top : top + 9, left : left + 9] = RED
    seen = decoded(encoded(picture, 95))
    red = (seen[..., 0] > 150) & (seen[..., 1] < 80)
    was = cv2.cvtColor(picture, cv2.COLOR_BGR2RGB)[..., 0] > 200
    assert (red == was).all()
