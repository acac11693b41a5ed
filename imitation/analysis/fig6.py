"""Fig. 6: trajectories during low level imitation, area by area and between the areas."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from imitation.analysis.fig6_claims import Mimicking, claims_of_fig6
from imitation.analysis.figure_style import COLOURS, FAINT, FULL_WIDTH, INK, Drawn, style
from imitation.analysis.imitations import Followed, Imitations
from imitation.analysis.visual_axes import visual_space
from imitation.arrays import Array
from imitation.visuo_motor_map import VisuoMotorMap

SELECTIONS = {"winner": ("winner", COLOURS[1]), "soft": ("soft", COLOURS[0])}
AGAINST = COLOURS[3]  # the arm that draws before the mirror
LEFT = 38.0  # what lies left of here is never learned [px]


def draw_fig6(runs: Sequence[Imitations], settings: Mimicking) -> Drawn:
    """Trajectories on one map, two curves over all maps, and what is claimed of them."""
    with style():
        figure = Figure(figsize=(FULL_WIDTH, 3.3))
        shown = typical(runs, settings.slow)
        columns = len(shown.of("winner", settings.slow))
        left = figure.add_gridspec(
            2, columns, left=0.07, right=0.755, bottom=0.135, top=0.85, wspace=0.08, hspace=0.12
        )
        for row, selection in enumerate(SELECTIONS):
            _gestures(figure, left, row, selection, shown, settings)
        right = figure.add_gridspec(
            2, 1, left=0.845, right=0.985, bottom=0.135, top=0.85, hspace=0.68
        )
        _smoothness(figure.add_subplot(right[0]), runs, settings)
        _mirror(figure.add_subplot(right[1]), runs)
        figure.legend(
            handles=_marks(), loc="upper left", ncols=4, columnspacing=1.4,
            bbox_to_anchor=(0.06, 1.01), handlelength=1.8,
        )  # fmt: skip
    return figure, claims_of_fig6(runs, settings)


def typical(runs: Sequence[Imitations], period: float) -> Imitations:
    """The map on which the winner's distances are the median ones."""
    far = [np.mean([one.told["path_rmse_px"] for one in run.of("winner", period)]) for run in runs]
    return runs[int(np.argsort(far, kind="stable")[(len(runs) - 1) // 2])]


def _gestures(
    figure: Figure, grid: Any, row: int, selection: str, shown: Imitations, settings: Mimicking
) -> None:
    name, colour = SELECTIONS[selection]
    for column, one in enumerate(shown.of(selection, settings.slow)):
        axes = figure.add_subplot(grid[row, column])
        _trajectories(axes, shown.learned, one, colour)
        if row == 0:
            axes.set_title(one.gesture.replace("_", " "), loc="left")
            axes.set_xlabel("")
            axes.tick_params(labelbottom=False)
        if column == 0:
            axes.set_ylabel(f"{name}: y [px]")
        else:
            axes.set_ylabel("")
            axes.tick_params(labelleft=False)


def _trajectories(axes: Any, learned: VisuoMotorMap, one: Followed, colour: str) -> None:
    visual_space(axes, learned.field)
    axes.set_xlim(LEFT, learned.field.size[0])
    axes.set_xticks([40, 80, 120])
    _, places = learned.memories()
    axes.scatter(*places.T, s=9, facecolors="white", edgecolors=INK, linewidths=0.6, zorder=3)
    axes.plot(*one.own.T, color=colour, linewidth=1.1, zorder=5)
    axes.plot(*one.shown.T, color=INK, linewidth=0.9, linestyle=(0, (3, 2)), zorder=6)
    told = f"{one.told['path_rmse_px']:.1f} px, {one.told['lag_s']:.2f} s"
    box = {"facecolor": "white", "alpha": 0.85, "pad": 1.0, "linewidth": 0}
    axes.text(42, 2, told, fontsize=6, va="top", zorder=8, bbox=box)


def _smoothness(axes: Any, runs: Sequence[Imitations], settings: Mimicking) -> None:
    """Lag against jitter over the time constant of the arm: medians over gestures and maps."""
    axes.axvline(settings.lag_s, color=FAINT, linewidth=0.8, linestyle=(0, (4, 2)))
    axes.text(settings.lag_s + 0.01, 0.012, "human", fontsize=6, color="#777777")
    for selection, (_, colour) in SELECTIONS.items():
        taus = sorted({one.tau for one in runs[0].smoothed})
        points = np.array([_median_point(runs, selection, tau) for tau in taus])
        axes.plot(*points.T, "o-", color=colour, markersize=2.5, linewidth=0.9)
        for tau, (lag, jitter) in zip(taus, points, strict=True):
            if tau in (taus[0], taus[-1]):
                axes.annotate(
                    f"{tau:g}", (lag, jitter), xytext=(2, 3), textcoords="offset points",
                    fontsize=6, color=colour, ha="left", va="bottom",
                )  # fmt: skip
    axes.set(xlabel="lag [s]", ylabel="2-3 Hz jitter [px]", ylim=(0.01, 3))
    axes.set_xlim(0, 1.25 * axes.dataLim.x1)  # room for what stands beside the last point
    axes.set_yscale("log")
    axes.set_yticks([0.01, 0.1, 1], ["0.01", "0.1", "1"])
    axes.set_title(f"τ [s], {settings.quick:g} s a lap", loc="left")


def _median_point(runs: Sequence[Imitations], selection: str, tau: float) -> tuple[float, float]:
    found = [
        (one.lag_s, one.jitter_px)
        for run in runs
        for one in run.smoothed
        if (one.selection, one.tau) == (selection, tau)
    ]
    lag, jitter = np.median(found, axis=0)
    return float(lag), float(jitter)


def _mirror(axes: Any, runs: Sequence[Imitations]) -> None:
    """How far aside the own hand goes against the deviation of the one that is seen."""
    deviations = np.array([one.deviation_px for one in runs[0].mirror])
    axes.axhline(0, color=FAINT, linewidth=0.6)
    drawn = np.array([[one.drawn_px for one in run.mirror] for run in runs])
    followed = np.array([[one.followed_px for one in run.mirror] for run in runs])
    for values, colour, name in ((drawn, AGAINST, "drawing"), (followed, COLOURS[0], "following")):
        _with_range(axes, deviations, values, colour)
        axes.annotate(
            name, (deviations[-1], np.median(values, axis=0)[-1]), xytext=(-6, 0), fontsize=6,
            textcoords="offset points", ha="right", va="center", color=colour,
        )  # fmt: skip
    axes.set(xlabel="seen hand [px]", ylabel="own hand [px]")
    axes.set_title("Mirror: aside", loc="left")


def _with_range(axes: Any, x: Array, values: Array, colour: str) -> None:
    """Median over the maps, and the range of all of them."""
    middle = np.median(values, axis=0)
    reach = np.abs(np.array((values.min(axis=0), values.max(axis=0))) - middle)
    axes.errorbar(x, middle, yerr=reach, color=colour, marker="o", markersize=2.5, linewidth=0.9,
                  elinewidth=0.8, capsize=1.5)  # fmt: skip


def _marks() -> list[Line2D]:
    place = Line2D(
        [], [], linestyle="none", marker="o", markersize=3.5, markerfacecolor="white", color=INK,
        label="learned place",
    )  # fmt: skip
    demonstrator = Line2D([], [], color=INK, linestyle=(0, (3, 2)), label="demonstrator's hand")
    robot = [
        Line2D([], [], color=colour, label=f"robot's hand, {name}")
        for name, colour in SELECTIONS.values()
    ]
    return [demonstrator, *robot, place]
