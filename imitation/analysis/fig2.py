"""Fig. 2: the flow of one control step, drawn from the functions that ran in it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from inspect import signature
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

from imitation.analysis.claims import Claim, every_claim
from imitation.analysis.figure_style import COLOURS, FULL_WIDTH, INK, Drawn, style
from imitation.analysis.tracing import Call

WIDE, HIGH = 0.88, 0.68  # of a box, in columns and rows
MARGIN, BOTTOM = 0.045, 2.43  # where long arrows go round, in columns and rows
ARROW = {
    "arrowstyle": "-|>",
    "linewidth": 0.9,
    "color": INK,
    "shrinkA": 1,
    "shrinkB": 1,
    "mutation_scale": 8,
}
KINDS = {"body": "#777777", "sense": COLOURS[0], "map": COLOURS[2], "law": COLOURS[1]}


@dataclass(frozen=True)
class Box:
    """One function of a step and what it hands on."""

    name: str
    kind: str  # of `KINDS`
    at: tuple[float, float]  # column, row in the picture
    function: Callable[..., Any]
    says: str  # what it does, in the paper's words
    symbol: str  # of what it hands on
    taken: Callable[[Any], Any]  # that, out of what it returned
    shape: tuple[str, ...]  # of that, as names of sizes or numbers
    after: tuple[str, ...] = ()  # boxes whose output it uses in the same step
    later: tuple[str, ...] = ()  # boxes whose output it uses in a later step

    @property
    def arguments(self) -> str:
        """Names of what the function is given."""
        names = [name for name in signature(self.function).parameters if name != "self"]
        return f"({', '.join(names)})"


@dataclass(frozen=True)
class Trace:
    """One real step."""

    calls: dict[str, Call]  # of the functions that ran, by their boxes' names
    sizes: dict[str, int]  # what the names in a shape stood for

    def confirms(self, box: Box) -> bool:
        """Whether the box's function returned what the box says."""
        if box.name not in self.calls:
            return False
        return self.found(box) == tuple(
            int(part) if part.isdigit() else self.sizes[part] for part in box.shape
        )

    def found(self, box: Box) -> tuple[int, ...]:
        """Shape of what the box handed on."""
        return tuple(np.shape(box.taken(self.calls[box.name].returned)))

    def ordered(self, first: str, then: str) -> bool:
        """Whether both ran, one after the other."""
        both = first in self.calls and then in self.calls
        return both and self.calls[first].order < self.calls[then].order


def draw_fig2(boxes: Sequence[Box], seeds: Sequence[Sequence[Trace]]) -> Drawn:
    """The flow with the shapes of the first seed, and whether every seed's steps were like that.

    Args:
        boxes: The functions.
        seeds: The steps of each seed: one of reaching first, others after it.
    """
    by_name = {box.name: box for box in boxes}
    with style():
        figure = Figure(figsize=(FULL_WIDTH, 3.9))
        axes: Any = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        for box in boxes:
            trace = next((one for one in seeds[0] if box.name in one.calls), None)
            _draw_box(axes, box, None if trace is None else trace.found(box))
            for name in box.after:
                far = abs(by_name[name].at[0] - box.at[0]) > 2
                draw = _draw_detour if far else _draw_arrow
                draw(axes, by_name[name].at, box.at, "-")
            for name in box.later:
                _draw_arrow(axes, by_name[name].at, box.at, "--")
        columns, rows = zip(*(box.at for box in boxes), strict=True)
        axes.set(xlim=(min(columns) - 0.51, max(columns) + 0.51))
        axes.set(ylim=(max(rows) + 0.62, min(rows) - 0.45))
        axes.text(
            min(columns) - WIDE / 2,
            max(rows) + 0.62,
            "Solid: within one step. Dashed: kept for a later step. Shapes in brackets were "
            "found in a real step.",
            fontsize=6.5,
            va="bottom",
        )
        axes.set_axis_off()
    return figure, _claims(boxes, seeds)


def _draw_box(axes: Any, box: Box, found: tuple[int, ...] | None) -> None:
    (x, y), colour = box.at, KINDS[box.kind]
    axes.add_patch(
        FancyBboxPatch(
            (x - WIDE / 2, y - HIGH / 2),
            WIDE,
            HIGH,
            boxstyle="round,pad=0,rounding_size=0.05",
            facecolor="white",
            edgecolor=colour,
            linewidth=1.2,
            zorder=3,
        )
    )
    name = box.function.__qualname__
    shape = "did not run" if found is None else f"[{' x '.join(map(str, found))}]"
    mono = "DejaVu Sans Mono"
    lines = (
        (-0.235, box.says, {"fontsize": 7.2, "color": INK}),
        (-0.105, name, {"fontsize": 5.1, "family": mono, "color": colour}),
        (0.065, fill(box.arguments, 26), {"fontsize": 5.2, "family": mono, "color": "#555555"}),
        (0.235, f"{box.symbol}  {shape}", {"fontsize": 7, "color": INK, "weight": "bold"}),
    )
    for down, words, look in lines:
        axes.text(x, y + down, words, ha="center", va="center", zorder=4, **look)


def _draw_arrow(axes: Any, start: tuple[float, float], end: tuple[float, float], line: str) -> None:
    """An arrow from the border of one box to that of another."""
    (x, y), way = start, np.subtract(end, start)
    leaving = min(
        WIDE / 2 / max(abs(way[0]), 1e-9),
        HIGH / 2 / max(abs(way[1]), 1e-9),
    )
    begin, tip = (x, y) + leaving * way, (x, y) + (1 - leaving) * way
    axes.annotate("", tip, begin, arrowprops={**ARROW, "linestyle": line}, zorder=2)


def _draw_detour(
    axes: Any, start: tuple[float, float], end: tuple[float, float], line: str
) -> None:
    """An arrow that goes round all boxes: down on the left, along the bottom, up on the right."""
    left, right = start[0] - WIDE / 2 - MARGIN, end[0] + WIDE / 2 + MARGIN
    xs = (start[0] - WIDE / 2, left, left, right, right)
    ys = (start[1], start[1], BOTTOM, BOTTOM, end[1])
    axes.plot(xs, ys, color=INK, linewidth=0.9, linestyle=line, zorder=2)
    tip = (end[0] + WIDE / 2, end[1])
    axes.annotate("", tip, (right, end[1]), arrowprops={**ARROW, "shrinkA": 0}, zorder=2)


def _claims(boxes: Sequence[Box], seeds: Sequence[Sequence[Trace]]) -> list[Claim]:
    found = [any(one.confirms(box) for one in steps) for steps in seeds for box in boxes]
    ordered = [
        any(one.ordered(name, box.name) for one in steps)
        for steps in seeds
        for box in boxes
        for name in box.after
    ]
    return [
        every_claim(
            "Every box ran in a real step and handed on what it says, in the shape stated "
            f"({len(boxes)} boxes on {len(seeds)} maps).",
            np.array(found),
        ),
        every_claim(
            "Along every solid arrow the box at its tip ran after the one it comes from.",
            np.array(ordered),
        ),
    ]
