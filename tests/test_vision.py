"""What of a frame is the hand."""

import numpy as np
import pytest

from imitation.arrays import Image
from imitation.vision import ColourDetector

RED, GREEN, BLUE, GREY = (255, 0, 0), (0, 255, 0), (0, 0, 255), (128, 128, 128)


def frame_of(colour: tuple[int, int, int], *spots: tuple[int, int]) -> Image:
    """A grey frame of 6 by 4 px with `spots` (row, column) of one colour."""
    frame = np.full((4, 6, 3), GREY, dtype=np.uint8)
    for spot in spots:
        frame[spot] = colour
    return frame


def detector(hue: tuple[int, int] = (170, 10), min_pixels: int = 1) -> ColourDetector:
    return ColourDetector(hue, saturation=(100, 255), value=(80, 255), min_pixels=min_pixels)


def test_only_the_pixels_of_the_hands_colour_are_the_hand():
    mask = detector().mask(frame_of(RED, (1, 2), (3, 5)))
    assert np.argwhere(mask).tolist() == [[1, 2], [3, 5]]


@pytest.mark.parametrize("colour", [GREEN, BLUE, GREY, (0, 0, 0), (255, 255, 255), (40, 0, 0)])
def test_other_colours_and_dark_or_pale_pixels_are_not_the_hand(colour):
    assert not detector().mask(frame_of(colour, (0, 0))).any()


def test_a_hue_range_that_closes_the_circle_finds_both_sides_of_red():
    orange_red, purple_red = (255, 40, 0), (255, 0, 40)
    for colour in (orange_red, RED, purple_red):
        assert detector(hue=(170, 10)).mask(frame_of(colour, (0, 0)))[0, 0]


def test_a_hue_range_in_order_does_not_close_the_circle():
    assert detector(hue=(50, 70)).mask(frame_of(GREEN, (0, 0)))[0, 0]
    assert not detector(hue=(50, 70)).mask(frame_of(RED, (0, 0))).any()


def test_colour_means_red_green_blue_in_this_order():
    assert detector(hue=(110, 130)).mask(frame_of(BLUE, (0, 0)))[0, 0]
    assert not detector(hue=(110, 130)).mask(frame_of(RED, (0, 0))).any()


def test_hand_pixels_are_x_y_with_their_centres_at_half():
    pixels = detector().hand_pixels(frame_of(RED, (1, 2), (3, 5)))
    assert pixels.tolist() == [[2.5, 1.5], [5.5, 3.5]]


def test_fewer_pixels_than_asked_are_no_hand():
    frame = frame_of(RED, (0, 0), (0, 1))
    assert detector(min_pixels=3).hand_pixels(frame).shape == (0, 2)
    assert detector(min_pixels=2).hand_pixels(frame).shape == (2, 2)


def test_own_and_others_hand_are_both_the_hand():
    pixels = detector().hand_pixels(frame_of(RED, (0, 0), (3, 5)))
    assert pixels.mean(axis=0).tolist() == [3.0, 2.0]


@pytest.mark.parametrize(
    ("name", "ranges"),
    [
        ("hue", ((-1, 10), (0, 255), (0, 255))),
        ("hue", ((0, 180), (0, 255), (0, 255))),
        ("saturation", ((0, 10), (0, 256), (0, 255))),
        ("saturation", ((0, 10), (200, 100), (0, 255))),
        ("value", ((0, 10), (0, 255), (255, 80))),
    ],
)
def test_a_range_that_cannot_be_is_refused_by_name(name, ranges):
    with pytest.raises(ValueError, match=f"vision.{name}"):
        ColourDetector(*ranges, min_pixels=1)
