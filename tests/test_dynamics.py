"""Eqs. 1 and 2 against their closed forms."""

from itertools import product

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from imitation.arrays import Array
from imitation.dynamics import (
    Dynamics,
    able_to_stop,
    activation,
    attraction,
    diffusion_noise,
    homeostatic,
    reaching,
    uniform_noise,
)

coordinates = st.floats(-1.0, 1.0)
postures = arrays.arrays(np.float64, 3, elements=coordinates)
several = arrays.arrays(np.float64, (5, 3), elements=coordinates)
some_weights = arrays.arrays(np.float64, 5, elements=st.sampled_from([0.0, 0.01, 0.3, 1.0, 2.0]))
betas = st.floats(0.1, 1000.0)

ARM = Dynamics(np.array([-2.0, 0.0]), np.array([2.0, 1.0]), tau=0.2, beta=20.0)


def follow(x: Array, attractors: Array, step: float, steps: int, power: int = 2) -> Array:
    """The path of eq. 1 without noise, A = 1 and beta = 20, (steps + 1, n_joints)."""
    weights, path = np.ones(len(attractors)), [x]
    for _ in range(steps):
        path.append(path[-1] + step * attraction(path[-1], attractors, weights, 20.0, power))
    return np.array(path)


def places_kept_apart(attractors: Array, power: int) -> int:
    """At how many places the paths that start near the attractors end."""
    ends = [follow(x + 0.01, attractors, 0.5, 400, power)[-1] for x in attractors]
    apart: list[Array] = []
    for end in ends:
        if all(np.linalg.norm(end - other) > 0.02 for other in apart):
            apart.append(end)
    return len(apart)


def test_arm_is_pulled_exactly_onto_its_only_attractor():
    x, attractors = np.zeros(3), np.array([[0.1, -0.2, 0.3]])
    assert attraction(x, attractors, np.ones(1), beta=20) == pytest.approx(attractors[0])


def test_midway_between_two_equal_attractors_there_is_no_pull():
    attractors = np.array([[-0.5, 0.0], [0.5, 0.0]])
    assert attraction(np.zeros(2), attractors, np.ones(2), beta=20) == pytest.approx([0, 0])


def test_two_attractors_share_the_pull_as_equation_2_says():
    attractors, weights = np.array([[0.1], [-0.3]]), np.array([2.0, 1.0])
    near, far = 2 * np.exp(-20 * 0.01), np.exp(-20 * 0.09)
    expected = (near * 0.1 + far * -0.3) / (near + far)
    assert attraction(np.zeros(1), attractors, weights, beta=20) == pytest.approx([expected])


@given(postures, several, some_weights, betas, st.sampled_from([0.001, 0.5, 3.0, 1e6]))
def test_only_relative_weights_matter(x, attractors, weights, beta, scale):
    np.testing.assert_allclose(
        attraction(x, attractors, weights, beta),
        attraction(x, attractors, scale * weights, beta),
        atol=1e-9,
    )


@given(postures, several, some_weights, betas, postures)
def test_the_pull_leads_into_the_convex_hull_of_the_attractors(x, attractors, weights, beta, u):
    assume(weights.any())
    taking_part = attractors[weights > 0]
    along = u @ (x + attraction(x, attractors, weights, beta))
    assert (taking_part @ u).min() - 1e-9 <= along <= (taking_part @ u).max() + 1e-9


@given(postures, several, some_weights, betas)
def test_the_pull_is_at_most_the_distance_to_the_farthest_attractor(x, attractors, weights, beta):
    assume(weights.any())
    farthest = np.linalg.norm(attractors[weights > 0] - x, axis=1).max()
    assert np.linalg.norm(attraction(x, attractors, weights, beta)) <= farthest + 1e-9


@given(postures, several, betas, st.permutations(range(5)))
def test_the_pull_does_not_depend_on_the_order_of_the_attractors(x, attractors, beta, order):
    np.testing.assert_allclose(
        attraction(x, attractors, np.ones(5), beta),
        attraction(x, attractors[order], np.ones(5), beta),
        atol=1e-9,
    )


@pytest.mark.parametrize("power", [2, 4])
@pytest.mark.parametrize("beta", [20.0, 1000.0, 1e6])
def test_attractors_too_far_for_plain_exponentials_still_pull(beta, power):
    attractors = np.array([[1.0, 1.0, 1.0], [1.0, 1.0, 0.9]])
    share = activation(-np.ones(3), attractors, np.ones(2), beta, power)
    assert share.sum() == pytest.approx(1.0)
    assert share[1] > share[0]
    pull = attraction(-np.ones(3), attractors, np.ones(2), beta, power)
    assert np.isfinite(pull).all()
    assert (pull > 1.8).all()


def test_a_high_beta_follows_the_nearest_attractor_and_a_low_one_the_mean_of_all():
    attractors = np.array([[0.2], [-0.6]])
    assert attraction(np.zeros(1), attractors, np.ones(2), 1000.0) == pytest.approx([0.2])
    mean = attraction(np.zeros(1), attractors, np.ones(2), 1e-6)
    assert mean == pytest.approx([-0.2], abs=1e-6)


@given(postures, several, some_weights)
def test_the_pull_is_the_downhill_slope_of_the_potential(x, attractors, weights):
    assume(weights.any())

    def potential(at: Array) -> float:
        return -np.log(weights @ np.exp(-2.0 * np.sum((attractors - at) ** 2, axis=1))) / 4.0

    step = 1e-5 * np.eye(3)
    slope = [(potential(x + e) - potential(x - e)) / 2e-5 for e in step]
    np.testing.assert_allclose(
        attraction(x, attractors, weights, 2.0), np.negative(slope), atol=1e-6
    )


def test_without_weights_there_is_no_pull():
    assert not attraction(np.ones(3), np.zeros((2, 3)), np.zeros(2), beta=20).any()
    assert not attraction(np.ones(3), np.empty((0, 3)), np.empty(0), beta=20).any()


def test_steps_below_twice_the_time_constant_converge_and_larger_ones_do_not():
    attractor = np.array([[0.3, -0.2]])
    stable = np.abs(follow(np.zeros(2), attractor, 1.99, 1000) - attractor)
    unstable = np.abs(follow(np.zeros(2), attractor, 2.05, 1000) - attractor)
    assert stable[-1].max() < 1e-4
    assert unstable[-1].min() > 1e6


@given(st.floats(0.01, 1.0))
def test_steps_up_to_the_time_constant_approach_without_overshoot(step):
    path = follow(np.zeros(1), np.array([[0.5]]), step, 50)[:, 0]
    assert (np.diff(path) >= -1e-15).all()
    assert path.max() <= 0.5 + 1e-15


def test_the_single_square_keeps_apart_attractors_that_the_text_read_literally_merges():
    cube = np.array(list(product((-0.25, 0.25), repeat=3)))
    assert places_kept_apart(cube, power=2) == 8
    assert places_kept_apart(cube, power=4) == 1


def simulated_density(
    attractors: Array, weights: Array, sigma: float, edges: Array, h: float
) -> Array:
    """Share of time that eq. 1 with diffusion spends in each bin, on a line with mirrors at +-1."""
    rng, walkers = np.random.default_rng(0), 4000
    grid = np.linspace(-1.2, 1.2, 2401)
    beta = 5.0
    pull = [attraction(np.array([x]), attractors, weights, beta)[0] for x in grid]
    x = rng.uniform(-1, 1, walkers)
    counts = np.zeros(len(edges) - 1)
    for step in range(4000):
        noise = diffusion_noise(rng, walkers, sigma, h)  # one joint of each walker
        x = x + h * (np.interp(x, grid, pull) + noise)
        x = np.where(np.abs(x) > 1, np.sign(x) * 2 - x, x)
        if step > 2000 and step % 10 == 0:
            counts += np.histogram(x, edges)[0]
    return counts / counts.sum()


def test_with_diffusion_the_arm_is_found_where_the_closed_form_says():
    attractors, weights, sigma = np.array([[-0.5], [0.4]]), np.array([1.0, 2.0]), 0.4
    edges = np.linspace(-1, 1, 41)
    middle = (edges[1:] + edges[:-1]) / 2
    wells = weights @ np.exp(-5.0 * (attractors - middle) ** 2)
    expected = wells ** (1 / (5.0 * sigma**2))  # A = 1
    expected /= expected.sum()
    found = simulated_density(attractors, weights, sigma, edges, h=0.01)
    total_variation = np.abs(found - expected).sum() / 2
    assert total_variation < 0.015


def spread(noise, h: float) -> float:
    """Variance of where noise alone leads in one time constant, in steps of `h`."""
    places = np.zeros(20_000)
    for _ in range(round(1 / h)):
        places += h * noise(h)
    return float(places.var())


def test_diffusion_does_not_depend_on_the_step_but_uniform_noise_does():
    rng, n = np.random.default_rng(1), 20_000
    for h in (0.1, 0.02):
        assert spread(lambda h: diffusion_noise(rng, n, 0.5, h), h) == pytest.approx(0.25, rel=0.05)
        uniform = spread(lambda h: uniform_noise(rng, n, 0.5), h)
        assert uniform == pytest.approx(0.25 * h / 3, rel=0.05)  # sigma = level sqrt(h / 3)


@given(st.integers(0, 2**32 - 1), st.floats(0.0, 2.0))
def test_uniform_noise_stays_within_its_level(seed, level):
    noise = uniform_noise(np.random.default_rng(seed), 6, level)
    assert noise.shape == (6,)
    assert (np.abs(noise) <= level).all()


def test_an_arm_without_attractors_is_still_even_when_noise_is_handed_in():
    pull = ARM.pull(np.array([0.3, 0.2]), np.empty((0, 2)), np.empty(0))
    assert pull.activation.shape == (0,)
    assert pull.shares.shape == (0, 2)
    assert ARM.velocity(pull, gain=1.0, noise=np.ones(2)).tolist() == [0.0, 0.0]


def test_velocity_is_in_radians_per_second_by_each_joints_range():
    attractor = np.array([[1.0, 0.25]])  # 0.5 and -0.5 when scaled
    pull = ARM.pull(np.array([0.0, 0.5]), attractor, np.ones(1))
    assert pull.shares.tolist() == [[0.5, -0.5]]
    assert ARM.velocity(pull, 1.0, np.zeros(2)) == pytest.approx([1.0 / 0.2, -0.25 / 0.2])
    assert ARM.velocity(pull, 0.0, np.array([0.1, 0.1])) == pytest.approx([0.2 / 0.2, 0.05 / 0.2])


@given(arrays.arrays(np.float64, (4, 2), elements=st.floats(-5, 5)))
def test_scaling_joints_and_back_is_the_same_posture(posture):
    np.testing.assert_allclose(ARM.unscaled(ARM.scaled(posture)), posture, atol=1e-12)
    np.testing.assert_array_equal(ARM.scaled(np.stack((ARM.lower, ARM.upper))), [[-1, -1], [1, 1]])


def test_the_shares_of_all_attractors_add_up_to_the_pull():
    attractors, weights = np.array([[1.0, 0.2], [-1.0, 0.9], [0.5, 0.5]]), np.array([1.0, 0.5, 2.0])
    pull = ARM.pull(np.array([0.4, 0.4]), attractors, weights)
    x, scaled = ARM.scaled(np.array([0.4, 0.4])), ARM.scaled(attractors)
    assert pull.activation.sum() == pytest.approx(1.0)
    assert pull.shares.sum(axis=0) == pytest.approx(attraction(x, scaled, weights, 20.0))


def test_the_homeostatic_controller_pulls_without_noise():
    assert homeostatic() == (1.0, 0.0)


def test_reaching_pulls_only_while_the_distance_shrinks_and_its_noise_is_the_distances():
    assert reaching(20.0, 21.0, gain_per_px=0.02, noise_per_px=0.01) == pytest.approx((0.4, 0.2))
    assert reaching(20.0, 20.0, gain_per_px=0.02, noise_per_px=0.01) == pytest.approx((0.0, 0.2))
    assert reaching(20.0, 19.0, gain_per_px=0.02, noise_per_px=0.01) == pytest.approx((0.0, 0.2))


def test_reaching_rests_at_the_target():
    assert reaching(0.0, 5.0, gain_per_px=0.02, noise_per_px=0.01) == (0.0, 0.0)


distances = arrays.arrays(np.float64, 3, elements=st.floats(-2.0, 2.0))
accelerations = arrays.arrays(np.float64, 3, elements=st.floats(0.5, 20.0))


@given(distances, accelerations, st.floats(0.05, 0.4))
def test_an_arm_that_is_able_to_stop_never_overshoots(to_go, acceleration, tau):
    period, before = 0.04, np.zeros(3)
    start = to_go.copy()
    for _ in range(600):
        wanted = able_to_stop(to_go / tau, to_go, acceleration, period)
        step = acceleration * period
        before = np.clip(wanted, before - step, before + step)
        to_go = to_go - before * period
        assert (to_go * np.sign(start) >= -1e-9).all()
    np.testing.assert_allclose(to_go, 0.0, atol=1e-3)


@given(distances, distances, accelerations)
def test_slowing_keeps_the_line_of_the_movement(velocity, to_go, acceleration):
    slowed = able_to_stop(velocity, to_go, acceleration, 0.04)
    assert (np.abs(slowed) <= np.abs(velocity) + 1e-12).all()
    np.testing.assert_allclose(np.outer(slowed, velocity), np.outer(velocity, slowed), atol=1e-9)


def test_far_from_its_end_a_movement_is_not_slowed():
    velocity = np.array([0.1, -0.2, 0.0])
    slowed = able_to_stop(velocity, np.array([1.0, -1.0, 1.0]), np.full(3, 2.0), 0.04)
    assert slowed.tolist() == velocity.tolist()
