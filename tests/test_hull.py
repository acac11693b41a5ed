"""Convex hulls in joint space and in the image."""

import numpy as np
import pytest

from imitation.hull import (
    clip_outline,
    depth_inside,
    nearest_mixture,
    onto_simplex,
    outline,
    uniform_inside,
)

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
TRIANGLE = np.array([[10.0, 10.0], [50.0, 10.0], [10.0, 50.0]])  # [px]


@pytest.mark.parametrize(
    ("weights", "nearest"),
    [
        ([0.2, 0.3, 0.5], [0.2, 0.3, 0.5]),
        ([1.0, 1.0], [0.5, 0.5]),
        ([3.0, 0.0], [1.0, 0.0]),
        ([-1.0, 0.4, 0.4], [0.0, 0.5, 0.5]),
        ([0.0, 0.0, 0.0], [1 / 3, 1 / 3, 1 / 3]),
    ],
)
def test_weights_become_the_nearest_shares(weights, nearest):
    assert onto_simplex(np.array(weights)) == pytest.approx(nearest)


def test_a_point_inside_is_its_own_nearest_mixture():
    for point in ([0.5, 0.5], [0.1, 0.9], [1.0, 0.3], [0.0, 0.0]):
        assert nearest_mixture(SQUARE, np.array(point)) == pytest.approx(point, abs=1e-6)


@pytest.mark.parametrize(
    ("point", "nearest"),
    [([2.0, 0.5], [1.0, 0.5]), ([-1.0, -3.0], [0.0, 0.0]), ([0.3, 1.7], [0.3, 1.0])],
)
def test_a_point_outside_becomes_the_nearest_one_of_the_hull(point, nearest):
    assert nearest_mixture(SQUARE, np.array(point)) == pytest.approx(nearest, abs=1e-6)


def test_four_postures_of_five_joints_span_what_lies_between_them_and_no_more():
    rng = np.random.default_rng(3)
    corners = rng.uniform(-2.0, 2.0, (4, 5))
    for _ in range(20):
        inside = rng.dirichlet(np.ones(4)) @ corners
        assert nearest_mixture(corners, inside) == pytest.approx(inside, abs=1e-3)
        beyond = corners[0] + 0.5 * (corners[0] - corners[1:].mean(axis=0))
        found = nearest_mixture(corners, beyond)
        assert np.linalg.norm(found - beyond) <= np.linalg.norm(corners[0] - beyond) + 1e-6


def test_a_single_posture_is_the_nearest_to_everything():
    only = np.array([[0.4, -0.2, 1.0]])
    assert nearest_mixture(only, np.array([3.0, 3.0, 3.0])) == pytest.approx(only[0])


def test_places_inside_are_no_corners_of_the_outline():
    places = np.concatenate((SQUARE * 40, [[20.0, 20.0], [5.0, 30.0]]))
    assert sorted(outline(places).tolist()) == sorted((SQUARE * 40).tolist())


@pytest.mark.parametrize(
    ("place", "depth"),
    [((15.0, 15.0), 5.0), ((10.0, 30.0), 0.0), ((4.0, 20.0), -6.0), ((33.0, 33.0), -(2**0.5) * 3)],
)
def test_depth_is_the_distance_to_the_outline_negative_outside(place, depth):
    assert depth_inside(TRIANGLE, np.array(place)) == pytest.approx(depth, abs=1e-5)


def test_an_outline_is_cut_off_at_the_edges_of_the_image():
    cut = clip_outline(TRIANGLE, np.array([0.0, 0.0]), np.array([30.0, 160.0]))
    corners = [[10.0, 10.0], [10.0, 50.0], [30.0, 10.0], [30.0, 30.0]]
    assert np.array(sorted(cut.tolist())) == pytest.approx(np.array(corners))


def test_nothing_is_left_of_an_outline_beyond_the_edges():
    assert clip_outline(TRIANGLE, np.array([60.0, 60.0]), np.array([90.0, 90.0])).shape == (0, 2)


def test_places_are_drawn_inside_and_evenly():
    rng = np.random.default_rng(0)
    drawn = np.array([uniform_inside(TRIANGLE, rng) for _ in range(2000)])
    assert min(depth_inside(TRIANGLE, place) for place in drawn) >= 0
    assert drawn.mean(axis=0) == pytest.approx(TRIANGLE.mean(axis=0), abs=1.0)
    near_corner = (drawn[:, 0] < 30) & (drawn[:, 1] < 30)
    assert near_corner.mean() == pytest.approx(0.5, abs=0.05)  # 400 of 800 px^2
