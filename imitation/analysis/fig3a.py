"""Fig. 3a: paths of eq. 1 in joint space that converge without noise."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from imitation.analysis.claims import Claim, every_claim, rate_claim
from imitation.analysis.figure_style import COLOURS, FAINT, FULL_WIDTH, INK, style
from imitation.analysis.joint_paths import End, Simulation, end_of
from imitation.analysis.joint_space import handle, joint_space, legend, mark_attractors
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
