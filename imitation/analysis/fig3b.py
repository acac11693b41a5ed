"""Fig. 3b: paths of eq. 1 in joint space that explore with noise."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from imitation.analysis.claims import Claim, value_claim
from imitation.analysis.figure_style import COLOURS, FAINT, FULL_WIDTH, style
from imitation.analysis.joint_paths import Order, Simulation, jumps, visits
from imitation.analysis.joint_space import handle, joint_space, legend, mark_attractors
from imitation.analysis.statistics import bootstrap
from imitation.arrays import Array


@dataclass(frozen=True)
class Exploration:
    """Settings of Fig. 3b; its YAML says what each means."""

    simulation: Simulation
    iterations: int
    noise_level: float
    ratios: Sequence[float]
    visited: float
    jumps: float
    growing: float
    resamples: int


def fig3b(seeds: Sequence[int], settings: Exploration) -> tuple[Figure, list[Claim]]:
    """Paths that jump between attractors (Fig. 3b), and what is claimed of them."""
    paths = [_exploring(seed, settings.noise_level, settings) for seed in seeds]
    counts = np.array([jumps(path.order) for path in paths])
    curve = _curve(seeds, settings)
    typical = paths[int(np.argsort(counts, kind="stable")[len(counts) // 2])]
    return _jumping(typical, curve, settings), _claims_of_exploration(counts, curve, settings)


@dataclass(frozen=True)
class Exploring:
    """One path with noise."""

    attractors: Array  # (n, joints) [-1..1]
    postures: Array  # (iterations + 1, joints) [-1..1]
    order: Order  # attractor visited last at each of them, (iterations + 1,)


def _exploring(seed: int, noise_level: float, settings: Exploration) -> Exploring:
    """A seed's path: the same attractors, start and course of noise at every noise level."""
    rng, simulation = np.random.default_rng(seed), settings.simulation
    attractors = simulation.random_postures(rng, simulation.attractors)
    start = simulation.random_postures(rng, 1)[0]
    path = simulation.path(start, attractors, settings.iterations, noise_level, rng)
    return Exploring(attractors, path, visits(path, attractors, simulation.beta, settings.visited))


def _curve(seeds: Sequence[int], settings: Exploration) -> Array:
    """Number of jumps by seed and ratio of A to noise level, (seeds, ratios)."""
    levels = [settings.simulation.gain / ratio for ratio in settings.ratios]
    return np.array(
        [[jumps(_exploring(seed, level, settings).order) for level in levels] for seed in seeds]
    )


def _claims_of_exploration(counts: Array, curve: Array, settings: Exploration) -> list[Claim]:
    more_noise = np.argsort(settings.ratios)[::-1]
    growing = np.diff(curve[:, more_noise], axis=1) >= 0
    rng = np.random.default_rng(0)
    return [
        value_claim(
            f"With noise the arm jumps from an attractor to another (median number of jumps in "
            f"{settings.iterations} iterations).",
            [counts[[i]] for i in range(len(counts))],
            lambda values: float(np.median(values)),
            "at least",
            settings.jumps,
            "jumps",
            rng,
            settings.resamples,
        ),
        value_claim(
            "The lower the ratio of A to noise level, the more jumps (steps to a lower ratio "
            "that bring as many or more).",
            list(growing.astype(np.float64)),
            lambda values: float(values.mean()),
            "at least",
            settings.growing,
            "share",
            rng,
            settings.resamples,
        ),
    ]


def _jumping(shown: Exploring, curve: Array, settings: Exploration) -> Figure:
    with style():
        figure = Figure(figsize=(FULL_WIDTH, 3.3))
        axes = joint_space(figure, (0.0, 0.0, 0.5, 0.94))
        changes = np.flatnonzero(np.diff(shown.order)) + 1
        for piece in np.split(np.arange(len(shown.postures)), changes):
            # Each piece reaches to the next one, so that the path has no gaps.
            part = shown.postures[piece[0] : piece[-1] + 2]
            last = shown.order[piece[0]]
            colour = FAINT if last < 0 else COLOURS[last % len(COLOURS)]
            axes.plot(*part.T[:3], color=colour, linewidth=0.35, alpha=0.75)
        mark_attractors(axes, shown.attractors)
        legend(
            figure,
            handle(
                "o", "attractor (the path has the colour of the one visited last)", FAINT, 6, True
            ),
        )
        _jumps_over_ratio(figure, curve, settings)
    return figure


def _jumps_over_ratio(figure: Figure, curve: Array, settings: Exploration) -> None:
    axes = figure.add_axes((0.61, 0.16, 0.37, 0.76))
    ratios, rng = np.array(settings.ratios), np.random.default_rng(0)
    axes.plot(ratios, curve.T, ".", color=FAINT, markersize=2.5, zorder=1)
    axes.plot([], [], ".", color=FAINT, markersize=2.5, label=f"each of {len(curve)} seeds")

    def median(values: Array) -> float:
        return float(np.median(values))

    bands = [bootstrap(column[:, None], median, rng, settings.resamples) for column in curve.T]
    axes.fill_between(
        ratios,
        [band.low for band in bands],
        [band.high for band in bands],
        color=COLOURS[0],
        alpha=0.25,
        linewidth=0,
        label="its 95 % interval",
    )
    axes.plot(
        ratios, np.median(curve, axis=0), "o-", color=COLOURS[0], markersize=3.5, label="median"
    )
    axes.set_xscale("log")
    axes.set_yscale("symlog", linthresh=1)
    axes.set_xticks(ratios, [f"{ratio:g}" for ratio in ratios])
    axes.set_xticks([], minor=True)
    axes.set_yticks([0, 1, 10, 100, 1000], ["0", "1", "10", "100", "1000"])
    axes.set_ylim(bottom=-0.1)
    axes.set(
        xlabel="A / \u03b5",
        ylabel=f"jumps in {settings.iterations} iterations",
    )
    drawn, labels = axes.get_legend_handles_labels()
    axes.legend([drawn[i] for i in (2, 1, 0)], [labels[i] for i in (2, 1, 0)])
