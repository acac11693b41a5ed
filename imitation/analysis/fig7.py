"""Fig. 7: an action shown once and reproduced, two successive positions in each picture."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure

from imitation.analysis.fig7_claims import Asked, Deferred, claims_of_fig7
from imitation.analysis.figure_style import COLOURS, FAINT, FULL_WIDTH, INK, Drawn, style
from imitation.analysis.triggers import Triggers
from imitation.analysis.visual_axes import visual_space
from imitation.arrays import Array, Image

ABOVE = (0.0, 22.0)  # arrows are drawn above the marks, x and y [px of the picture]
PANELS = 1.9  # height of the lowest row [inch]


@dataclass(frozen=True)
class Movement:
    """Two successive positions in one picture."""

    picture: Image
    way: Array  # of the hand's mark in the picture, from and to, (2, 2) [px]


@dataclass(frozen=True)
class Strip:
    """The movements of one run."""

    name: str
    movements: Sequence[Movement]


def draw_fig7(strips: Sequence[Strip], runs: Sequence[Deferred], asked: Asked) -> Drawn:
    """The strips above each other, what triggers below them, and what is claimed of the replays."""
    count = max(len(strip.movements) for strip in strips)
    height, width, _ = strips[0].movements[0].picture.shape
    tall = FULL_WIDTH / count * height / width + 0.22
    with style():
        figure = Figure(figsize=(FULL_WIDTH, len(strips) * tall + PANELS))
        low = PANELS / figure.get_figheight()
        grid = figure.add_gridspec(
            len(strips), count, left=0.0, right=1.0, bottom=low, top=0.96, wspace=0.02, hspace=0.13
        )
        for row, strip in enumerate(strips):
            _strip(figure, grid, row, strip)
        below = figure.add_gridspec(
            1, 2, left=0.06, right=0.80, bottom=0.4 / PANELS * low, top=0.83 * low, wspace=0.25
        )
        _table(figure.add_subplot(below[0]), runs[0].triggers)
        _ways(figure.add_subplot(below[1]), runs[0])
    return figure, claims_of_fig7(runs, asked)


def _strip(figure: Figure, grid: Any, row: int, strip: Strip) -> None:
    for column, movement in enumerate(strip.movements):
        ax = figure.add_subplot(grid[row, column])
        ax.set_axis_off()
        ax.imshow(movement.picture)
        _arrow(ax, movement.way)
        if not column:
            ax.set_title(strip.name, loc="left")


def _table(axes: Any, triggers: Triggers) -> None:
    """What a hand at each place triggers; the states' areas bear their numbers."""
    visual_space(axes, triggers.field)
    for state, area in enumerate(triggers.areas):
        if area is not None:
            x, y = triggers.field.centres[area]
            axes.text(x, y, f"{state + 1}", fontsize=12, ha="center", va="center", color=FAINT)
    for probe in triggers.probes:
        colour = "white" if probe.triggered is None else COLOURS[probe.triggered]
        axes.plot(*probe.place, "o", color=colour, markersize=4, markeredgecolor=INK,
                  markeredgewidth=0.5)  # fmt: skip
    for state, _ in enumerate(triggers.areas[:-1]):
        axes.plot([], [], "o", color=COLOURS[state], markersize=4, markeredgecolor=INK,
                  markeredgewidth=0.5, label=f"state {state + 1}")  # fmt: skip
    axes.plot([], [], "o", color="white", markersize=4, markeredgecolor=INK, label="nothing")
    axes.set_title("A hand here triggers the action from", loc="left")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), handletextpad=0.1)


def _ways(axes: Any, run: Deferred) -> None:
    """The empty hands of both arms, doing the same action."""
    visual_space(axes, run.triggers.field)
    for number, (name, path) in enumerate(run.paths.items()):
        axes.plot(*path.T, color=COLOURS[number], linewidth=1.1, label=name)
    if run.paths:
        axes.set_title("The same action by two arms", loc="left")
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    else:
        axes.set_visible(False)


def _arrow(ax: Any, way: Array) -> None:
    (x0, y0), (x1, y1) = way - ABOVE
    ax.annotate(
        "",
        (x1, y1),
        xytext=(x0, y0),
        arrowprops={
            "arrowstyle": "-|>",
            "linewidth": 1.4,
            "color": INK,
            "mutation_scale": 7,
            "connectionstyle": "arc3,rad=0.15",
            "shrinkA": 0,
            "shrinkB": 0,
        },
    )
