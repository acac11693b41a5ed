"""Fig. 3: paths of eq. 1 in joint space, converging without noise and exploring with it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from imitation.analysis.claims import Claim, every_claim, rate_claim, value_claim
from imitation.analysis.figure_style import COLOURS, FAINT, FULL_WIDTH, INK, style
from imitation.analysis.joint_paths import End, Order, Simulation, end_of, jumps, visits
from imitation.analysis.joint_space import handle, joint_space, legend, mark_attractors
from imitation.analysis.statistics import bootstrap
from imitation.arrays import Array


@dataclass(frozen=True)
class Convergence:
    """Settings of Fig. 3a; its YAML says what each means."""

    simulation: Simulation
    iterations: int
    paths: int
    drawn: int
    still: float
    near: float
    at_attractor: float
    at_nearest: float

    def run(self, start: Array, attractors: Array) -> Array:
        """The path without noise, (iterations + 1, joints)."""
        silent = np.random.default_rng(0)  # its draws are multiplied by 0
        return self.simulation.path(start, attractors, self.iterations, 0.0, silent)


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


def fig3a(seeds: Sequence[int], settings: Convergence) -> tuple[Figure, list[Claim]]:
    """Paths that converge to the nearest attractors (Fig. 3a), and what is claimed of them."""
    simulation, scenes, ends = settings.simulation, [], []
    for seed in seeds:
        rng = np.random.default_rng(seed)
        for _ in range(settings.paths):
            attractors = simulation.random_postures(rng, simulation.attractors)
            starts = simulation.random_postures(rng, settings.drawn)
            ends.append(end_of(settings.run(starts[0], attractors), attractors, simulation))
            scenes.append((starts, attractors))
    distances = np.array([end.distance for end in ends])
    # Most scenes have no merged attractors; the one whose path ended farthest off shows both.
    starts, attractors = scenes[int(np.argmax(distances[: settings.paths]))]
    figure = _converging(starts, attractors, distances, settings)
    return figure, _claims_of_convergence(ends, settings)


def _claims_of_convergence(ends: Sequence[End], settings: Convergence) -> list[Claim]:
    still = np.array([end.speed < settings.still for end in ends])
    near = np.array([end.distance < settings.near for end in ends])
    nearest = np.array([end.at_nearest for end in ends])
    return [
        every_claim("Without noise every path ends at a zero of f.", still),
        rate_claim(
            f"Paths end within {settings.near:g} of an attractor; the others end between "
            f"attractors that merged ({np.count_nonzero(~near)} of {len(near)}).",
            near,
            settings.at_attractor,
        ),
        rate_claim(
            "The trajectory converges to the attractor nearest to its start.",
            nearest,
            settings.at_nearest,
        ),
    ]


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


def _converging(
    starts: Array, attractors: Array, distances: Array, settings: Convergence
) -> Figure:
    with style():
        figure = Figure(figsize=(FULL_WIDTH, 3.3))
        axes = joint_space(figure, (0.0, 0.0, 0.5, 0.94))
        for start in starts:
            path = settings.run(start, attractors)
            apart = np.linalg.norm(attractors - path[-1], axis=1)
            axes.plot(*path.T[:3], color=COLOURS[apart.argmin() % len(COLOURS)], linewidth=1.0)
            axes.scatter(*start[:3], s=9, color=INK, linewidths=0, depthshade=False, zorder=5)
            if apart.min() > settings.near:
                axes.scatter(
                    *path[-1][:3], s=26, marker="s", facecolors="none", edgecolors=INK, zorder=10
                )
        mark_attractors(axes, attractors)
        legend(
            figure,
            handle("o", "attractor", FAINT, 6, True),
            handle("o", "start", INK, 2.5, True),
            handle("s", "end between merged attractors", INK, 5, False),
        )
        _distances_of_ends(figure, distances, settings)
    return figure


def _distances_of_ends(figure: Figure, distances: Array, settings: Convergence) -> None:
    axes = figure.add_axes((0.61, 0.16, 0.37, 0.76))
    near = distances < settings.near
    axes.ecdf(distances, color=COLOURS[0], linewidth=1.4)
    axes.axvline(settings.near, color=INK, linewidth=0.8, linestyle=(0, (4, 2)))
    axes.set(
        xscale="log",
        xlim=(1e-6, 0.5),
        ylim=(0, 1.02),
        xlabel="distance of the end from its nearest attractor",
        ylabel="share of paths",
    )
    axes.set_xticks([], minor=True)
    axes.text(
        settings.near / 1.5,
        0.05,
        f"{np.count_nonzero(near)} of {len(near)} paths end within {settings.near:g},\n"
        f"{np.count_nonzero(~near)} between merged attractors",
        ha="right",
        fontsize=7,
    )


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
