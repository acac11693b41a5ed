"""Fig. 3: paths that converge without noise and jump with it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hydra.utils import instantiate
from omegaconf import OmegaConf

from imitation.analysis.fig3a import fig3a
from imitation.analysis.fig3b import fig3b
from imitation.analysis.figure_style import save
from imitation.analysis.joint_paths import Simulation, end_of, jumps, visits

YAML = Path(__file__).parents[2] / "conf" / "figure" / "fig3.yaml"
ARM = Simulation(joints=2, attractors=2, beta=20.0, gain=1.0, step=0.1)
TWO = np.array([[-0.5, 0.0], [0.5, 0.0]])


@pytest.fixture
def convergence():
    return replace(configured("fig3a"), paths=20, drawn=4, iterations=300)


@pytest.fixture
def exploration():
    return replace(configured("fig3b"), iterations=400, ratios=[0.25, 2.0], resamples=50)


def configured(name):
    return instantiate(OmegaConf.load(YAML)[name], _convert_="all")


def test_the_papers_numbers_are_the_configured_ones():
    a, b = configured("fig3a"), configured("fig3b")
    assert (a.simulation.joints, a.simulation.attractors) == (3, 8)
    assert (a.simulation.beta, a.simulation.gain) == (20, 1)
    assert (a.iterations, b.iterations, b.noise_level) == (1000, 5000, 1)
    assert b.simulation == a.simulation


def test_a_path_without_noise_ends_at_the_attractor_nearest_to_its_start():
    path = ARM.path(np.array([0.2, 0.6]), TWO, 300, 0.0, np.random.default_rng(0))
    end = end_of(path, TWO, ARM)
    assert path.shape == (301, 2)
    assert end.at_nearest
    assert end.speed < 1e-8
    assert end.distance < 1e-6


def test_a_path_between_two_merged_attractors_ends_at_neither():
    merged = np.array([[-0.1, 0.0], [0.1, 0.0]])
    path = ARM.path(np.array([0.3, 0.3]), merged, 300, 0.0, np.random.default_rng(0))
    end = end_of(path, merged, ARM)
    assert path[-1] == pytest.approx([0.0, 0.0], abs=1e-4)
    assert end.speed < 1e-3
    assert end.distance == pytest.approx(0.1, abs=1e-3)


def test_joint_limits_stop_a_noisy_arm():
    path = ARM.path(np.zeros(2), TWO, 500, 20.0, np.random.default_rng(0))
    assert np.abs(path).max() == 1.0


def test_a_jump_is_counted_when_another_attractor_is_visited_not_on_the_way():
    there, between, here = TWO[0], np.zeros(2), TWO[1]
    path = np.array([between, there, between, there, between, here, here, between, there])
    order = visits(path, TWO, beta=20.0, visited=0.9)
    assert order.tolist() == [-1, 0, 0, 0, 0, 1, 1, 1, 0]
    assert jumps(order) == 2
    assert jumps(order[:1]) == 0


def test_fig3a_claims_what_the_caption_says(convergence):
    _, claims = fig3a([0, 1, 2], convergence)
    assert [claim.n for claim in claims] == [60, 60, 60]
    zero, near, nearest = claims
    assert zero.measured > 0.9
    assert near.measured > 0.8
    assert nearest.measured > 0.85


def test_fig3b_jumps_more_when_noise_outweighs_the_gain(exploration):
    _, (_, growing) = fig3b([0, 1], exploration)
    assert growing.measured == 1.0
    assert growing.passed


def test_a_seed_gives_the_same_claims_again(convergence):
    assert fig3a([3], convergence)[1] == fig3a([3], convergence)[1]


@pytest.mark.parametrize(("figure", "name"), [(fig3a, "convergence"), (fig3b, "exploration")])
def test_a_figure_is_saved_to_the_same_bytes_again(figure, name, request, tmp_path):
    settings = request.getfixturevalue(name)
    first, second = (
        [path.read_bytes() for path in save(figure([0], settings)[0], tmp_path / run, "fig")]
        for run in ("first", "second")
    )
    assert first == second


@pytest.mark.slow
def test_the_claims_of_fig3_come_true_over_20_seeds():
    claims = fig3a(range(20), configured("fig3a"))[1] + fig3b(range(20), configured("fig3b"))[1]
    assert [claim.sentence for claim in claims if not claim.passed] == []
