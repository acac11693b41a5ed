"""Axes in which visual space is drawn: the areas, the learned places, trajectories, targets."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from imitation.analysis.figure_style import COLOURS, INK
from imitation.analysis.reached import ReachedTrial, Situation
from imitation.arrays import Array
from imitation.visual_field import VisualField
from imitation.visuo_motor_map import VisuoMotorMap

GRID, WITHIN = "#D0D0D0", "#F3F1EA"  # borders of areas, the part of the image that is learned
ACTIVE = "#8A8A8A"  # attractors that take part


def visual_space(axes: Any, field: VisualField) -> None:
    """Make `axes` show visual space with the borders of the areas, y down as in an image."""
    width, height = field.size
    x_edges, y_edges = field.edges
    axes.add_patch(
        Rectangle((field.left, 0), width - field.left, height, facecolor=WITHIN, zorder=0)
    )
    axes.vlines(x_edges, 0, height, color=GRID, linewidth=0.6, zorder=1)
    axes.hlines(y_edges, 0, width, color=GRID, linewidth=0.6, zorder=1)
    axes.set(xlim=(0, width), ylim=(height, 0), aspect="equal", xlabel="x [px]", ylabel="y [px]")
    axes.set_xticks(np.arange(0, width + 1, 40))
    axes.set_yticks(np.arange(0, height + 1, 40))
    for side in ("top", "right"):
        axes.spines[side].set_visible(True)


def mark_places(axes: Any, learned: VisuoMotorMap, situation: Situation) -> None:
    """Draw where each learned posture showed the hand; those that take part are filled."""
    _, places = learned.memories()
    axes.scatter(*places.T, s=48, facecolors="white", edgecolors=INK, linewidths=1.0, zorder=3)
    axes.scatter(
        *situation.places.T, s=60, facecolors=ACTIVE, edgecolors=INK, linewidths=1.2, zorder=4
    )


def mark_target(axes: Any, target: Array) -> None:
    """Draw the target as a cross that is seen on what lies behind it."""
    x, y = target
    axes.plot(x, y, "+", color="white", markersize=12, markeredgewidth=3.2, zorder=8)
    axes.plot(x, y, "+", color=INK, markersize=11, markeredgewidth=1.8, zorder=9)


def draw_trajectories(axes: Any, trials: Sequence[ReachedTrial]) -> None:
    """Draw where the hand was seen until the target was reached; a star is the start."""
    for number, trial in enumerate(trials):
        colour = COLOURS[number % len(COLOURS)]
        path = trial.path[: trial.steps_until_reached]
        axes.plot(*path.T, color=colour, linewidth=0.9, zorder=5)
        seen = path[~np.isnan(path[:, 0])]
        if len(seen):
            axes.plot(
                *seen[0], "*", color=colour, markersize=10, markeredgecolor=INK,
                markeredgewidth=0.5, zorder=7,
            )  # fmt: skip


def marks_explained() -> list[Line2D]:
    """Handles of a legend for the marks above."""
    common: dict[str, Any] = {"linestyle": "none", "color": INK}
    return [
        Line2D([], [], marker="+", markersize=8, markeredgewidth=1.6, label="target", **common),
        _circle("attractor that takes part", ACTIVE),
        _circle("other learned place", "white"),
        Line2D([], [], marker="*", markersize=8, markerfacecolor="white", label="start", **common),
    ]


def _circle(label: str, fill: str) -> Line2D:
    return Line2D(
        [],
        [],
        linestyle="none",
        color=INK,
        marker="o",
        markersize=6,
        markerfacecolor=fill,
        label=label,
    )
