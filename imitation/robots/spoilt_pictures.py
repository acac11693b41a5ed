"""Pictures as they should not be: black, without the tag, with a second one."""

from collections.abc import Callable, Mapping

import cv2
import numpy as np

from imitation.arrays import Image

TAG, COVER = (219, 10, 10), (158, 132, 102)  # colours of the tag and of what hides it, RGB
SECOND_TAG = 6  # its radius [px]


def black(picture: Image) -> Image:
    """Nothing of `picture`."""
    return np.zeros_like(picture)


def without_tag(picture: Image) -> Image:
    """`picture` with the tag hidden."""
    red = TAG[0]
    looks_red = (picture[..., 0] > red / 2) & (picture[..., 1:] < red / 2).all(axis=2)
    return np.where(looks_red[..., None], np.array(COVER, dtype=np.uint8), picture)


def with_second_tag(picture: Image) -> Image:
    """`picture` with a second tag, in the middle above."""
    height, width = picture.shape[:2]
    both = picture.copy()
    cv2.circle(both, (width // 2, height // 4), SECOND_TAG, TAG, -1)
    return both


SPOILT: Mapping[str, Callable[[Image], Image]] = {
    "camera_black": black,
    "tag_lost": without_tag,
    "two_tags": with_second_tag,
}
