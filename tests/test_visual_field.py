"""The grid of visual neurons over the image."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from imitation.visual_field import VisualField, winner_take_all

RIGHT_4X4 = VisualField("right_4x4", size=(160, 120), rows=4, columns=4, left=40.0)
RIGHT_3X3 = VisualField("right_3x3", size=(160, 120), rows=3, columns=3, left=40.0)
FIELDS = pytest.mark.parametrize("field", [RIGHT_4X4, RIGHT_3X3], ids=lambda field: field.name)

places = arrays.arrays(
    np.float64, (7, 2), elements=st.floats(-50.0, 250.0, allow_nan=False)
)  # some within the image, some beside it
inputs = arrays.arrays(np.float64, (3, 4), elements=st.floats(0.0, 1.0))


def every_pixel() -> np.ndarray:
    """Centres of all pixels of the image, (n, 2)."""
    x, y = np.meshgrid(np.arange(160) + 0.5, np.arange(120) + 0.5)
    return np.column_stack((x.ravel(), y.ravel()))


@FIELDS
def test_every_pixel_of_the_image_lies_in_exactly_one_area(field):
    pixels = np.round(field.activity(every_pixel()) * 160 * 120)
    assert pixels.sum() == 160 * 120
    assert (pixels > 0).all()


@FIELDS
def test_areas_within_reach_are_equal_squares_on_the_right_of_the_left_column(field):
    shares = field.activity(every_pixel())
    assert shares[:, 1:] == pytest.approx(np.full((field.rows, field.columns), shares[0, 1]))
    assert shares[:, 0].sum() == pytest.approx(40 / 160)
    assert field.side == pytest.approx(120 / field.columns)


@FIELDS
def test_only_the_left_column_is_out_of_reach(field):
    assert not field.reachable[:, 0].any()
    assert field.reachable[:, 1:].all()
    assert field.reachable.sum() == field.rows * field.columns


def test_centres_lie_in_the_middle_of_the_areas():
    centres = RIGHT_3X3.centres
    assert centres.shape == (3, 4, 2)
    assert centres[0, 0].tolist() == [20, 20]
    assert centres[0, 1].tolist() == [60, 20]
    assert centres[2, 3].tolist() == [140, 100]


@FIELDS
def test_each_centre_lies_in_its_own_area(field):
    for area in np.ndindex(field.shape):
        assert field.area_of(field.centres[area]) == area


@pytest.mark.parametrize(
    ("place", "area"),
    [
        ((0.0, 0.0), (0, 0)),
        ((39.9, 0.0), (0, 0)),
        ((40.0, 0.0), (0, 1)),
        ((79.9, 39.9), (0, 1)),
        ((80.0, 40.0), (1, 2)),
        ((159.9, 119.9), (2, 3)),
        ((160.0, 50.0), None),
        ((50.0, 120.0), None),
        ((-0.1, 50.0), None),
        ((float("nan"), 50.0), None),
    ],
)
def test_a_border_belongs_to_the_area_after_it_and_the_far_edges_to_none(place, area):
    assert RIGHT_3X3.area_of(np.array(place)) == area


def test_activity_is_each_areas_share_of_the_hand():
    activity = RIGHT_3X3.activity(np.array([[41.0, 1.0], [42.0, 2.0], [81.0, 1.0], [1.0, 119.0]]))
    assert activity[0, 1] == 0.5
    assert activity[0, 2] == activity[2, 0] == 0.25
    assert activity.sum() == 1


def test_an_unseen_hand_excites_nothing():
    assert not RIGHT_3X3.activity(np.empty((0, 2))).any()


@given(places)
def test_activity_is_the_share_of_the_hand_inside_the_image(hand):
    inside = ((hand >= 0) & (hand < (160, 120))).all(axis=1)
    activity = RIGHT_4X4.activity(hand)
    assert activity.min() >= 0
    assert activity.sum() == pytest.approx(inside.mean())


@given(places, st.permutations(range(7)))
def test_activity_does_not_depend_on_the_order_of_the_pixels(hand, order):
    np.testing.assert_array_equal(RIGHT_4X4.activity(hand), RIGHT_4X4.activity(hand[order]))


def test_within_selects_the_four_areas_around_a_common_corner():
    selection = RIGHT_3X3.within(np.array([80.0, 40.0]), radius=30.0)
    assert np.argwhere(selection).tolist() == [[0, 1], [0, 2], [1, 1], [1, 2]]
    assert set(selection.ravel()) == {0.0, 1.0}


def test_within_leaves_out_an_area_exactly_at_the_radius():
    centre = RIGHT_3X3.centres[1, 1]
    assert RIGHT_3X3.within(centre, radius=40.0).sum() == 1
    assert RIGHT_3X3.within(centre, radius=40.001).sum() == 5


@given(st.tuples(st.floats(0, 160), st.floats(0, 120)).map(np.array), st.floats(1, 200))
def test_within_a_larger_radius_no_area_is_lost(place, radius):
    assert (RIGHT_3X3.within(place, radius) <= RIGHT_3X3.within(place, 1.5 * radius)).all()


@given(inputs)
def test_the_winner_takes_all(visual_input):
    selection = winner_take_all(visual_input)
    if not visual_input.any():
        assert not selection.any()
        return
    assert selection.sum() == 1
    assert visual_input[selection == 1] == visual_input.max()


@given(inputs)
def test_competing_again_changes_nothing(visual_input):
    once = winner_take_all(visual_input)
    np.testing.assert_array_equal(winner_take_all(once), once)


@given(inputs, st.sampled_from([0.125, 0.5, 2.0, 64.0]))
def test_the_winner_does_not_depend_on_the_scale_of_the_input(visual_input, scale):
    visual_input = visual_input.round(6)  # a subnormal input would vanish when scaled down
    np.testing.assert_array_equal(
        winner_take_all(visual_input), winner_take_all(scale * visual_input)
    )


def test_among_equals_the_first_area_wins():
    selection = winner_take_all(np.array([[0.0, 0.5], [0.5, 0.0]]))
    assert np.argwhere(selection).tolist() == [[0, 1]]
