"""Fig. 7: an action shown once and reproduced, two successive positions in each picture."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from imitation.analysis.claims import Claim, every_claim, value_claim
from imitation.analysis.deferred import PLACED
from imitation.analysis.figure_style import FULL_WIDTH, INK, Drawn, style
from imitation.analysis.statistics import wilson
from imitation.arrays import Array, Image

ABOVE = (0.0, 22.0)  # arrows are drawn above the marks, x and y [px of the picture]
Runs = Sequence[Mapping[str, Mapping[str, Any]]]  # of each seed, by condition: metrics


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


@dataclass(frozen=True)
class Asked:
    """What is asked of the replays; the YAML says what each means."""

    grasped: float
    placed: float
    median_s: float
    largest_s: float
    clock: float
    tick_s: float
    resamples: int


def draw_fig7(strips: Sequence[Strip], runs: Runs, asked: Asked) -> Drawn:
    """The strips above each other, and what is claimed of the replays."""
    count = max(len(strip.movements) for strip in strips)
    height, width, _ = strips[0].movements[0].picture.shape
    tall = FULL_WIDTH / count * height / width
    with style():
        figure = Figure(figsize=(FULL_WIDTH, len(strips) * (tall + 0.22)))
        axes = figure.subplots(len(strips), count, squeeze=False)
        for row, strip in zip(axes, strips, strict=True):
            row[0].set_title(strip.name, loc="left")
            for ax in row:
                ax.set_axis_off()
            for ax, movement in zip(row, strip.movements, strict=False):
                ax.imshow(movement.picture)
                _arrow(ax, movement.way)
        figure.subplots_adjust(left=0.0, right=1.0, bottom=0.0, top=0.96, wspace=0.02, hspace=0.13)
    return figure, claims(runs, asked)


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
            "mutation_scale": 9,
            "connectionstyle": "arc3,rad=0.15",
            "shrinkA": 3,
            "shrinkB": 3,
        },
    )


def claims(runs: Runs, asked: Asked) -> list[Claim]:
    """What is claimed of the replays."""
    seen = [run["seen"] for run in runs]
    rng = np.random.default_rng(0)
    timing = [np.abs(one["timing_error_s"]) for one in seen if one["timing_error_s"]]
    value = [
        ("median", float(asked.median_s), lambda values: float(np.median(values))),
        ("largest", float(asked.largest_s), lambda values: float(np.max(values))),
    ]
    return [
        every_claim("Order of the states, precision=seen.", _of(seen, "order_correct")),
        _share("The can is grasped, precision=seen.", _of(seen, "grasped"), asked.grasped),
        _share(
            f"The can stands within {100 * PLACED:g} cm of where the demonstrator put it.",
            _placed(seen),
            asked.placed,
        ),
        *(
            value_claim(
                f"Timing error, arm travel included: {name}.",
                timing,
                statistic,
                "at most",
                bound,
                "s",
                rng,
                asked.resamples,
            )
            for name, bound, statistic in value
        ),
        every_claim(
            f"The internal clock is right within {asked.clock:.0%} or one tick.",
            np.concatenate([_clock_right(one, asked) for one in seen]),
        ),
        *_of_other_conditions(runs),
    ]


def _of_other_conditions(runs: Runs) -> list[Claim]:
    found = []
    for name in runs[0]:
        if name == "seen":
            continue
        told = [run[name] for run in runs]
        found.append(every_claim(f"Order of the states: {name}.", _of(told, "order_correct")))
        placed = _placed(told)
        if name.startswith("without"):
            found.append(every_claim(f"Control: the can is not put there {name}.", 1.0 - placed))
        elif any(one["object_error_m"] is not None for one in told) and "later" not in name:
            sentence = f"The can stands within {100 * PLACED:g} cm of its goal: {name}."
            found.append(_share(sentence, placed, 0.0))
    return found


def _of(told: Sequence[Mapping[str, Any]], key: str) -> Array:
    return np.array([float(bool(one[key])) for one in told])


def _placed(told: Sequence[Mapping[str, Any]]) -> Array:
    errors = [one["object_error_m"] for one in told]
    return np.array([float(error is not None and error <= PLACED) for error in errors])


def _clock_right(told: Mapping[str, Any], asked: Asked) -> Array:
    errors, delays = told["clock_error_s"], told["delays_s"]
    return np.array(
        [
            float(abs(error) <= max(asked.clock * delay, asked.tick_s) + 1e-9)
            for error, delay in zip(errors, delays, strict=True)
        ]
    )


def _share(sentence: str, outcomes: Array, bound: float) -> Claim:
    """That this share of the seeds is so; 0 asked: it is only told."""
    n, true = len(outcomes), int(outcomes.sum())
    interval, rate = wilson(true, n), true / n
    ends = interval.low, interval.high
    return Claim(sentence, "at least", bound, rate, *ends, n, "share", rate >= bound)
