"""Fig. 5: distance to the target against time, and how other controllers do beside the paper's."""

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from imitation.analysis.fig5_claims import PAPER, Approaches, by_map, claims_of_fig5
from imitation.analysis.figure_style import COLOURS, FAINT, FULL_WIDTH, INK, Drawn, style
from imitation.analysis.reached import MapReaches, ReachedTrial, Reaches, typical, typical_of

DARK, LIGHT = "#555555", FAINT  # the paper's two lines
DRAWN = {  # controller: what it is called in the picture, colour, line
    "corrected_aim": ("corrected aim (ours)", COLOURS[2], "-"),
    PAPER: ("the paper's law", COLOURS[0], "-"),
    "noise": ("noise alone (K = 0)", COLOURS[1], "--"),
    "nearest": ("nearest posture", INK, ":"),
}


def draw_fig5(runs: Sequence[MapReaches], settings: Approaches) -> Drawn:
    """Distances on one map, the times over all maps, and what is claimed of them."""
    shown = typical(runs)
    with style():
        figure = Figure(figsize=(FULL_WIDTH, 2.75))
        left, right, times = figure.subplots(1, 3, width_ratios=(1, 1.2, 1.1))
        figure.subplots_adjust(left=0.065, right=0.985, bottom=0.155, top=0.80, wspace=0.28)
        if shown is not None:
            _distances(left, "Learned position", typical_of(shown.at_learned), settings)
            _distances(right, "Position not learned", shown.between, settings)
            _share_the_top(left, right)
        left.set_ylabel("distance to the target [px]")
        _times(times, runs)
        corners: tuple[tuple[Axes, Literal["upper left", "upper right"]], ...] = (
            (right, "upper left"),
            (times, "upper right"),
        )
        for axes, corner in corners:
            handles, labels = axes.get_legend_handles_labels()
            figure.legend(
                handles,
                labels,
                loc=corner,
                bbox_to_anchor=(0.055, 0.0, 0.945, 1.01),
                ncols=2,
                columnspacing=1.0,
                handlelength=1.8,
            )
    return figure, claims_of_fig5(runs, settings)


def _distances(axes: Any, title: str, reaches: Reaches | None, settings: Approaches) -> None:
    if reaches is None:
        axes.set_title(f"{title}: none", loc="left")
        return
    axes.set_title(f"{title}, {len(reaches.trials)} trials", loc="left")
    axes.axhline(
        reaches.situation.distances.mean(),
        color=DARK,
        linestyle=(0, (4, 2)),
        linewidth=1.1,
        label="average distance to the attractors",
    )
    axes.axhline(
        settings.tolerance_px,
        color=LIGHT,
        linewidth=1.4,
        label=f"reached below {settings.tolerance_px:g} px",
    )
    for number, trial in enumerate(reaches.trials):
        _approach(axes, trial, COLOURS[number % len(COLOURS)])
    axes.set(xlabel="time [s]", xlim=(0, None), ylim=(0, None))


def _approach(axes: Any, trial: ReachedTrial, colour: str) -> None:
    times, distances = np.array(trial.times), np.array(trial.distances)
    until = trial.steps_until_reached
    axes.plot(times[:until], distances[:until], color=colour, linewidth=0.9)
    axes.plot(times[until - 1 :], distances[until - 1 :], color=colour, linewidth=0.7, alpha=0.45)
    if trial.reached_s is not None:
        axes.plot(times[until - 1], distances[until - 1], "o", color=colour, markersize=3.5)


def _share_the_top(left: Any, right: Any) -> None:
    top = 1.02 * max(left.dataLim.y1, right.dataLim.y1)
    for axes in (left, right):
        axes.set_ylim(0, top)


def _times(axes: Any, runs: Sequence[MapReaches]) -> None:
    """How many of the trials of all maps had reached the target after a time."""
    limit = max((one.limit for trials in by_map(runs, PAPER) for one in trials), default=1.0)
    for name, (label, colour, line) in DRAWN.items():
        trials = [one for of_map in by_map(runs, name) for one in of_map]
        arrived = np.sort([one.reached_s for one in trials if one.reached_s is not None])
        times = np.concatenate(([0.01], arrived, [limit]))
        share = np.append(np.arange(len(arrived) + 1), len(arrived)) / max(len(trials), 1)
        axes.step(times, share, where="post", color=colour, linestyle=line, label=label)
    axes.set(xscale="log", xlim=(0.1, limit), ylim=(-0.01, 1.02), xlabel="time [s]")
    axes.set(ylabel="share of trials that arrived")
    axes.set_title("The same, on all maps", loc="left")
    axes.set_xticks([0.1, 1, 10, 60], ["0.1", "1", "10", "60"])
    axes.set_xticks([], minor=True)
