"""Fig. 4: trajectories of the hand in visual space, to a learned position and to one between."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from imitation.analysis.claims import Claim, every_claim, rate_claim, value_claim
from imitation.analysis.figure_style import FULL_WIDTH, Drawn, style
from imitation.analysis.reached import MapReaches, Reaches, typical, typical_of
from imitation.analysis.visual_axes import (
    draw_trajectories,
    mark_places,
    mark_target,
    marks_explained,
    visual_space,
)
from imitation.arrays import Array


@dataclass(frozen=True)
class Trajectories:
    """Settings of Fig. 4; its YAML says what each means."""

    reached: float
    average_px: float
    average_within_px: float
    resamples: int


def draw_fig4(runs: Sequence[MapReaches], settings: Trajectories) -> Drawn:
    """Trajectories on one map, and what is claimed of all maps."""
    shown = typical(runs)
    with style():
        figure = Figure(figsize=(FULL_WIDTH, 3.1))
        left, right = figure.subplots(1, 2)
        figure.subplots_adjust(left=0.065, right=0.985, bottom=0.13, top=0.83, wspace=0.16)
        if shown is not None:
            _panel(left, "Learned position", shown, typical_of(shown.at_learned))
            _panel(right, "Position not learned", shown, shown.between)
        figure.legend(handles=marks_explained(), loc="upper center", ncols=4, columnspacing=1.6)
    return figure, _claims(runs, settings)


def _panel(axes: Any, title: str, shown: MapReaches, reaches: Reaches | None) -> None:
    visual_space(axes, shown.learned.field)
    if reaches is None:
        axes.set_title(f"{title}: none", loc="left")
        return
    mark_places(axes, shown.learned, reaches.situation)
    draw_trajectories(axes, reaches.trials)
    mark_target(axes, reaches.situation.target)
    active = len(reaches.situation.active)
    axes.set_title(f"{title}, {active} attractors, {len(reaches.trials)} trials", loc="left")


def _claims(runs: Sequence[MapReaches], settings: Trajectories) -> list[Claim]:
    between = [run.between for run in runs if run.between]
    at_learned = [reaches for run in runs for reaches in run.at_learned]
    holding = sum(bool(run.at_learned) for run in runs)
    average = settings.average_px
    return [
        every_claim(
            "A position not learned lies between four learned attractors that all take part.",
            np.array([run.between is not None for run in runs]),
        ),
        value_claim(
            f"The four learned places are about {average:g} px from it (mean over the four; "
            f"median difference from {average:g} px).",
            [np.array([abs(one.situation.distances.mean() - average)]) for one in between],
            lambda values: float(np.median(values)),
            "at most",
            settings.average_within_px,
            "px",
            np.random.default_rng(0),
            settings.resamples,
        ),
        rate_claim(
            "From every start the hand is led to a learned position at which 2 attractors take "
            f"part ({len(at_learned)} such positions on {holding} of {len(runs)} maps).",
            _reached(at_learned),
            settings.reached,
        ),
        rate_claim(
            "From every start the hand is led to the position between four learned ones.",
            _reached(between),
            settings.reached,
        ),
    ]


def _reached(reaches: Sequence[Reaches]) -> Array:
    arrived = [trial.reached_s is not None for one in reaches for trial in one.trials]
    return np.array(arrived, dtype=np.float64)
