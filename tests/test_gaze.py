"""Visual space does not change when the camera's neck moves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from imitation.gaze import VisualSpace, rotation
from imitation.robots.bullet.photograph import BulletScene
from imitation.robots.bullet.world import Mark, World
from imitation.robots.bullet.world_table import Table
from imitation.vision import ColourDetector

SPACE = VisualSpace(size=(160, 120), focal=278.2, centre=(80.0, 60.0), reference=(0.0, -1.2))
EYE = np.array([0.10, 0.15, 0.80])
HOME = np.array([0.28, 1.24, -1.49, 0.85, 0.0])  # the mark is near the middle of the image [rad]

turns = st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1)).map(np.array)
gazes = st.tuples(st.floats(-3.0, 3.0), st.floats(-1.5, 1.5)).map(np.array)
pixels = st.tuples(st.floats(0.0, 160.0), st.floats(0.0, 120.0)).map(np.array)


def seen_from(gaze) -> VisualSpace:
    """The image plane of the same camera at another gaze."""
    return VisualSpace(SPACE.size, SPACE.focal, SPACE.centre, (float(gaze[0]), float(gaze[1])))


@given(gazes)
def test_camera_axes_are_a_right_handed_rotation(gaze):
    axes = rotation(gaze)
    np.testing.assert_allclose(axes.T @ axes, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)


def test_gaze_zero_looks_ahead_with_left_on_the_left():
    right, down, forward = rotation(np.zeros(2)).T
    np.testing.assert_allclose(forward, (1, 0, 0), atol=1e-15)
    np.testing.assert_allclose(right, (0, -1, 0), atol=1e-15)
    np.testing.assert_allclose(down, (0, 0, -1), atol=1e-15)


def test_pan_turns_left_and_tilt_turns_up():
    np.testing.assert_allclose(rotation(np.array([np.pi / 2, 0]))[:, 2], (0, 1, 0), atol=1e-15)
    np.testing.assert_allclose(rotation(np.array([0, np.pi / 2]))[:, 2], (0, 0, 1), atol=1e-15)


def test_at_the_reference_gaze_the_image_is_the_visual_space():
    points = np.array([[0.5, 0.5], [159.5, 119.5]])
    assert SPACE.to_visual_space(points, np.array(SPACE.reference)) is points


def test_the_middle_of_the_image_moves_by_focal_length_times_tangent_of_the_tilt():
    place = SPACE.to_visual_space(np.array([[80.0, 60.0]]), np.array([0.0, -1.1]))
    assert place[0] == pytest.approx([80.0, 60.0 - SPACE.focal * np.tan(0.1)])


@given(pixels, turns)
def test_to_another_gaze_and_back_is_the_same_place(pixel, turn):
    gaze = np.array(SPACE.reference) + turn
    there = seen_from(gaze).to_visual_space(pixel[None], np.array(SPACE.reference))
    back = SPACE.to_visual_space(there, gaze)
    np.testing.assert_allclose(back[0], pixel, atol=1e-6)


@given(st.tuples(st.floats(0.2, 0.5), st.floats(-0.1, 0.3), st.floats(0.0, 0.2)), turns)
def test_a_still_point_of_the_world_keeps_its_place_while_the_neck_moves(position, turn):
    position, gaze = np.array(position), np.array(SPACE.reference) + turn
    in_image = seen_from(gaze).project(position, EYE)
    place = SPACE.to_visual_space(in_image[None], gaze)
    np.testing.assert_allclose(place[0], SPACE.project(position, EYE), atol=1e-6)


def test_what_is_behind_the_reference_image_plane_has_no_place():
    backwards = np.array([np.pi, 1.2])
    assert np.isnan(SPACE.to_visual_space(np.array([[80.0, 60.0]]), backwards)).all()


def test_a_point_behind_the_camera_is_not_projected():
    behind = EYE - rotation(np.array(SPACE.reference))[:, 2]
    assert np.isnan(SPACE.project(behind, EYE)).all()


def test_no_points_stay_no_points():
    assert SPACE.to_visual_space(np.empty((0, 2)), np.array([0.1, -1.1])).shape == (0, 2)


@pytest.fixture(scope="module")
def scene():
    world = World(
        urdf="katana_6m180.urdf",
        joints=tuple(
            f"katana_motor{joint}_joint"
            for joint in ("1_pan", "2_lift", "3_lift", "4_lift", "5_wrist_roll")
        ),
        fingers=None,
        mark=Mark("katana_gripper_link", (0.030, 0.0, 0.045), 0.012, (1.0, 0.0, 0.0, 1.0)),
        table=Table((1.0, 0.9, 0.04), (0.3, 0.0, -0.02), (0.6, 0.6, 0.55, 1.0), 0.8),
        base=(0.0, 0.0, 0.0),
        rate=250,
        iterations=50,
        force=(60.0, 60.0, 60.0, 40.0, 20.0),
    )
    world.rebuild(HOME, opening=1.0)
    yield BulletScene(world)
    world.close()


def seen_mark(scene, gaze):
    """Where the mark is seen, in visual space [px]."""
    red = ColourDetector((170, 10), (150, 255), (80, 255), min_pixels=5)
    found = red.hand_pixels(scene.photograph(SPACE, EYE, gaze))
    assert len(found) > 20
    return SPACE.to_visual_space(found, gaze).mean(axis=0)


@pytest.mark.parametrize("turn", [(0.0, 0.0), (0.1, 0.0), (-0.1, 0.0), (0.0, 0.1), (-0.1, -0.05)])
def test_the_rendered_hand_at_rest_is_seen_in_one_place_while_the_neck_moves(scene, turn):
    truth = SPACE.project(scene.world.mark_position(), EYE)
    place = seen_mark(scene, np.add(SPACE.reference, turn))
    assert np.linalg.norm(place - truth) < 1.0


@given(pixels, st.floats(0.0, 0.5))
def test_a_place_put_into_the_world_at_some_height_is_seen_where_it_was(pixel, height):
    there = SPACE.unproject(pixel, EYE, height)
    assert there[2] == pytest.approx(height)
    np.testing.assert_allclose(SPACE.project(there, EYE), pixel, atol=1e-9)


@given(st.tuples(st.floats(0.2, 0.5), st.floats(-0.1, 0.3), st.floats(0.0, 0.2)))
def test_a_point_of_the_world_that_is_seen_is_found_again_at_its_height(position):
    position = np.array(position)
    found = SPACE.unproject(SPACE.project(position, EYE), EYE, position[2])
    np.testing.assert_allclose(found, position, atol=1e-9)


def test_no_point_higher_than_the_eye_is_seen_by_looking_down():
    assert np.isnan(SPACE.unproject(np.array([80.0, 60.0]), EYE, EYE[2] + 0.1)).all()
