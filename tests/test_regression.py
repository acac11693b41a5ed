"""Local linear regression."""

import numpy as np
import pytest

from imitation.regression import locally_linear

SLOPE = np.array([[0.5, -1.0, 2.0], [0.0, 3.0, 1.0]])  # (2, 3)
OFFSET = np.array([1.0, 2.0, 3.0])
GRID = np.stack(np.meshgrid(np.arange(5.0), np.arange(4.0)), axis=-1).reshape(-1, 2)


def line(places) -> np.ndarray:
    return np.asarray(places) @ SLOPE + OFFSET


@pytest.mark.parametrize(
    ("at", "bandwidth"), [((2.0, 1.0), 0.5), ((0.3, 2.9), 3.0), ((9.0, -7.0), 30.0)]
)
def test_a_line_is_found_exactly_wherever_it_is_asked_for(at, bandwidth):
    value, slope = locally_linear(GRID, line(GRID), np.array(at), bandwidth, ridge=1e-12)
    assert value == pytest.approx(line(at), abs=1e-4)
    assert slope == pytest.approx(SLOPE, abs=1e-4)


def test_samples_near_the_place_count_and_far_ones_do_not():
    far = np.array([[100.0, 100.0], [101.0, 90.0]])
    inputs, outputs = np.concatenate((GRID, far)), np.concatenate((line(GRID), np.ones((2, 3))))
    value, slope = locally_linear(inputs, outputs, np.array([2.0, 2.0]), 2.0, ridge=1e-9)
    assert value == pytest.approx(line((2.0, 2.0)), abs=1e-4)
    assert slope == pytest.approx(SLOPE, abs=1e-4)


def test_a_curve_is_followed_by_its_tangent():
    inputs = np.linspace(-3, 3, 121)[:, None]
    value, slope = locally_linear(inputs, inputs**2, np.array([1.0]), 0.1, ridge=1e-9)
    assert value == pytest.approx([1.0], abs=0.02)
    assert slope == pytest.approx(np.array([[2.0]]), abs=0.02)


def test_a_narrow_bandwidth_does_not_underflow_far_from_all_samples():
    value, slope = locally_linear(GRID, line(GRID), np.array([500.0, 500.0]), 0.01, ridge=1.0)
    assert np.isfinite(value).all()
    assert np.isfinite(slope).all()


def test_where_samples_tell_no_slope_the_ridge_keeps_it_0_and_the_value_their_mean():
    inputs = np.array([[1.0, 1.0], [1.0, 1.0]])
    value, slope = locally_linear(inputs, np.array([[2.0], [4.0]]), np.array([1.0, 1.0]), 1.0, 0.1)
    assert value == pytest.approx([3.0])
    assert slope == pytest.approx(np.zeros((2, 1)))


def test_a_larger_ridge_means_a_smaller_slope():
    at = np.array([2.0, 1.5])
    sizes = [
        np.linalg.norm(locally_linear(GRID, line(GRID), at, 2.0, ridge)[1])
        for ridge in (1e-9, 1.0, 100.0)
    ]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[2] < 0.1 * sizes[0]
