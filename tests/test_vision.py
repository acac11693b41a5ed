"""What of a frame is the hand."""

import dataclasses

import cv2
import numpy as np
import pytest
import yaml

from cli.keys import CONF
from imitation.arrays import Image
from imitation.robot import Observation
from imitation.vision import ColourDetector, HandDetector, MovementDetector

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


def patches(*sizes: int) -> Image:
    """A grey frame of 20 by 60 px with squares of red, `sizes` px wide, apart from each other."""
    frame = np.full((20, 60, 3), GREY, dtype=np.uint8)
    for number, size in enumerate(sizes):
        frame[2 : 2 + size, 2 + 15 * number : 2 + 15 * number + size] = RED
    return frame


def test_specks_beside_a_large_patch_are_no_hand():
    detector = HandDetector(
        (170, 10), (100, 255), (80, 255), min_pixels=1, least_patch=0.3, most=0.35, length=None
    )
    assert detector.mask(patches(10, 5, 8)).sum() == 10 * 10 + 8 * 8
    assert detector.mask(patches(5)).sum() == 25
    assert not detector.mask(patches()).any()
    assert len(detector.hand_pixels(patches(10, 2))) == 100


def test_of_an_arm_that_reaches_in_only_the_hand_is_seen():
    frame = np.full((120, 160, 3), GREY, dtype=np.uint8)
    frame[50:60, 60:] = RED  # an arm from the right edge
    frame[20:30, 20:80] = RED  # another that comes in by no edge
    detector = HandDetector(
        (170, 10), (100, 255), (80, 255), 1, least_patch=0.3, most=0.35, length=30
    )
    found = np.argwhere(detector.mask(frame))
    arm, whole = found[found[:, 0] > 40], found[found[:, 0] < 40]
    assert arm[:, 1].min() == 60 and arm[:, 1].max() == pytest.approx(90, abs=1)
    assert len(whole) == 10 * 60
    all_counts = dataclasses.replace(detector, length=None)
    assert all_counts.mask(frame).sum() == 10 * 100 + 10 * 60


def test_a_table_of_the_hands_colour_is_no_hand_and_hides_none_that_lies_elsewhere():
    detector = HandDetector(
        (170, 10), (100, 255), (80, 255), 1, least_patch=0.3, most=0.35, length=None
    )
    frame = np.full((120, 160, 3), GREY, dtype=np.uint8)
    frame[70:] = RED
    assert not detector.mask(frame).any()
    frame[20:30, 20:40] = RED
    assert detector.hand_pixels(frame).mean(axis=0) == pytest.approx((30, 25))


def skin_detector() -> HandDetector:
    with (CONF / "vision" / "skin.yaml").open() as file:
        node = yaml.safe_load(file)
    del node["_target_"]
    return HandDetector(**node)


# Photographed skin from very light to very dark, in plain light [RGB].
SKIN = [
    (241, 194, 170),
    (224, 172, 145),
    (198, 134, 102),
    (160, 105, 80),
    (110, 70, 52),
    (75, 48, 38),
]
WALLS = [(225, 222, 215), (128, 128, 128), (120, 150, 190), (120, 170, 120), (235, 220, 180)]
WOOD = (158, 132, 102)  # the simulated table


@pytest.mark.parametrize("wall", WALLS)
@pytest.mark.parametrize("skin", SKIN)
@pytest.mark.parametrize("light", [0.75, 1.0])
def test_hands_light_and_dark_are_seen_before_many_walls_and_nothing_else(skin, wall, light):
    frame = np.full((120, 160, 3), wall, dtype=np.uint8)
    cv2.ellipse(frame, (100, 50), (30, 15), 20, 0, 360, skin, -1)
    noise = np.random.default_rng(0).normal(0, 3, frame.shape)
    shot = np.clip(frame * light + noise, 0, 255).astype(np.uint8)
    pixels = skin_detector().hand_pixels(shot)
    assert pixels.mean(axis=0) == pytest.approx((100.5, 50.5), abs=1.0)
    assert len(pixels) == pytest.approx(np.pi * 30 * 15, rel=0.1)


def test_the_simulated_table_is_no_skin():
    assert not skin_detector().mask(np.full((4, 6, 3), WOOD, dtype=np.uint8)).any()


def seen_at(step: int, x: float, gaze: float = 0.0, frame_step: int | None = None) -> Observation:
    """What is seen at a step of 0.1 s: a dark square at `x` [px]."""
    frame = np.full((40, 60, 3), GREY, dtype=np.uint8)
    frame[15:25, int(x) : int(x) + 10] = 40
    captured = 100_000_000 * (step if frame_step is None else frame_step)
    nothing = np.zeros(2)
    return Observation(
        100_000_000 * step, nothing, nothing, np.array((gaze, 0.0)), frame, captured,
        np.array((gaze, 0.0)), nothing, 1.0, np.inf, False, begins=step == 0,
    )  # fmt: skip


def movement(keep: float = 0.25, apart: float = 0.0, margin: float = 0.0) -> MovementDetector:
    return MovementDetector(20, apart, blur=0.5, min_pixels=10, keep=keep, margin=margin)


def test_what_moves_is_the_hand_and_what_rests_is_not():
    detector = movement()
    assert not len(detector.hand_in(seen_at(0, 20)))
    assert not len(detector.hand_in(seen_at(1, 20)))
    pixels = detector.hand_in(seen_at(2, 24))  # 4 px left free and 4 px newly covered
    assert pixels.mean(axis=0) == pytest.approx((27, 20), abs=0.5)


def test_a_hand_that_comes_to_rest_is_seen_there_for_a_while():
    detector = movement(keep=0.25)
    seen = [len(detector.hand_in(seen_at(step, 20 + 4 * min(step, 1)))) for step in range(6)]
    assert [count > 0 for count in seen] == [False, True, True, True, False, False]


def test_a_slow_hand_is_seen_over_several_frames():
    slowly = [seen_at(step, 20 + step) for step in range(6)]  # a row of 10 px a frame
    few, more = (MovementDetector(20, apart, 0.5, 50, 0.0, 0.0) for apart in (0.0, 0.3))
    assert not any(len(few.hand_in(seen)) for seen in slowly)
    assert [len(more.hand_in(seen)) > 0 for seen in slowly] == [False] * 3 + [True] * 3


def test_a_hand_that_leaves_the_picture_is_seen_there_no_more():
    detector = movement(keep=0.25, margin=15)
    seen = [len(detector.hand_in(seen_at(step, 30 + 10 * min(step, 2)))) for step in range(5)]
    assert [count > 0 for count in seen] == [False, True, True, False, False]


def test_a_frame_that_is_delivered_again_is_not_a_hand_at_rest():
    once, again = movement(keep=0.0), movement(keep=0.0)
    frames = [(0, 20), (1, 24), (2, 28)]
    for step, x in frames:
        pixels = once.hand_in(seen_at(step, x))
        assert (again.hand_in(seen_at(step, x)) == pixels).all()
        assert (again.hand_in(seen_at(step, x, frame_step=step)) == pixels).all()


def test_neither_a_new_episode_nor_a_turn_of_the_neck_is_a_movement():
    detector = movement()
    for first in (seen_at(0, 20), seen_at(0, 40), seen_at(5, 20, gaze=0.1)):
        assert not len(detector.hand_in(first))
