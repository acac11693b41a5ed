"""Axes in which paths through joint space are drawn, with their legend."""

from typing import Any

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from imitation.analysis.figure_style import COLOURS, INK
from imitation.arrays import Array

VIEW = {"elev": 22, "azim": -58}  # from where joint space is seen [degrees]


def joint_space(figure: Figure, place: tuple[float, float, float, float]) -> Any:
    """Axes of the first three joints within `place` (left, bottom, width, height)."""
    axes: Any = figure.add_axes(place, projection="3d")
    axes.view_init(**VIEW)
    axes.computed_zorder = False
    axes.set_box_aspect((1, 1, 1), zoom=0.95)
    for axis, label in ((axes.xaxis, "joint 1"), (axes.yaxis, "joint 2"), (axes.zaxis, "joint 3")):
        axis.set_pane_color((1, 1, 1, 0))
        axis._axinfo["grid"].update(color="#E4E4E4", linewidth=0.4)
        axis.line.set_linewidth(0.6)
        axis.set_label_text(label)
        axis.labelpad = -6
        axis.set_tick_params(pad=-3)
        # Labels at the corners would run into each other.
        axis.set_ticks([-1, -0.5, 0, 0.5, 1], ["", "\u22120.5", "0", "0.5", ""])
    axes.zaxis.set_tick_params(pad=0)
    axes.zaxis.labelpad = -3
    axes.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1, 1))
    return axes


def mark_attractors(axes: Any, attractors: Array) -> None:
    """Draw `attractors` (n, n_joints) [-1..1], each in its colour."""
    colours = [COLOURS[i % len(COLOURS)] for i in range(len(attractors))]
    axes.scatter(
        *attractors.T[:3],
        c=colours,
        s=42,
        edgecolors=INK,
        linewidths=0.6,
        depthshade=False,
        zorder=9,
    )


def legend(figure: Figure, *handles: Line2D) -> None:
    """Explain the marks, in one row above joint space."""
    figure.legend(
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.27, 1.0),
        ncols=len(handles),
        handletextpad=0.2,
        columnspacing=1.0,
    )


def handle(marker: str, label: str, colour: str, size: float, filled: bool) -> Line2D:
    """A mark for the legend, `size` in points."""
    return Line2D(
        [],
        [],
        linestyle="none",
        marker=marker,
        label=label,
        color=INK,
        markersize=size,
        markeredgewidth=0.7,
        markerfacecolor=colour if filled else "none",
    )
