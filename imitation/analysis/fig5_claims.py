"""What Fig. 5 claims: under 3 px where nothing was learned, and faster than noise alone."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from imitation.analysis.claims import Claim, rate_claim, surely, value_claim
from imitation.analysis.reached import MapReaches, ReachedTrial
from imitation.arrays import Array

PAPER = "yuragi"  # the controller of the paper; the others go by their names in the YAML


@dataclass(frozen=True)
class Approaches:
    """Settings of Fig. 5; its YAML says what each means."""

    tolerance_px: float
    reached: float
    nearest_px: float
    held: float
    held_s: float
    resamples: int

    def median_claim(
        self,
        sentence: str,
        groups: Sequence[Array],
        comparison: Literal["at least", "at most"],
        bound: float,
        unit: str,
    ) -> Claim:
        """That the median of all maps' values keeps to a bound."""
        rng = np.random.default_rng(0)
        return value_claim(sentence, groups, median, comparison, bound, unit, rng, self.resamples)


def median(values: Array) -> float:
    """Their median."""
    return float(np.median(values))


def by_map(runs: Sequence[MapReaches], controller: str) -> list[tuple[ReachedTrial, ...]]:
    """The trials of a controller to the place between four, for each map that has it."""
    with_place = [run for run in runs if run.between]
    if controller == PAPER:
        return [run.between.trials for run in with_place if run.between]
    return [run.others[controller].trials for run in with_place]


def claims_of_fig5(runs: Sequence[MapReaches], settings: Approaches) -> list[Claim]:
    """What is claimed over all maps."""
    at_learned = [trial for run in runs for one in run.at_learned for trial in one.trials]
    paper = by_map(runs, PAPER)
    under = f"under {settings.tolerance_px:g} px"
    return [
        rate_claim(f"A learned position is reached {under}.", _ok(at_learned), settings.reached),
        rate_claim(
            f"A position not learned, between four that are, is reached {under}.",
            np.concatenate([_ok(trials) for trials in paper]),
            settings.reached,
        ),
        settings.median_claim(
            "There the hand is this far from the target when the movement is stopped (median).",
            [np.array([trial.stopped_px for trial in trials]) for trials in paper],
            "at most",
            settings.tolerance_px,
            "px",
        ),
        *_nearest(runs, settings),
        *_against_noise(runs, settings),
        *_corrected_aim(runs, settings),
    ]


def _nearest(runs: Sequence[MapReaches], settings: Approaches) -> list[Claim]:
    places = [run.between.situation.distances.min() for run in runs if run.between]
    alone = [np.array([one.final_px for one in trials]) for trials in by_map(runs, "nearest")]
    rest = [np.array([one.final_px for one in trials]) for trials in by_map(runs, PAPER)]
    bound = settings.nearest_px
    return [
        settings.median_claim(
            "The nearest learned place is about 20 px away (median over maps).",
            [np.array([place]) for place in places],
            "at least",
            bound,
            "px",
        ),
        settings.median_claim(
            "The nearest posture alone (controller=nearest) brings the hand no nearer (median).",
            alone,
            "at least",
            bound,
            "px",
        ),
        settings.median_claim(
            "After the stop the arm still brakes: it rests nearer than any single learned posture "
            "would bring it (median).",
            rest,
            "at most",
            bound,
            "px",
        ),
    ]


def _against_noise(runs: Sequence[MapReaches], settings: Approaches) -> list[Claim]:
    pairs = []
    for noise, paper in zip(by_map(runs, "noise"), by_map(runs, PAPER), strict=True):
        same_starts = zip(noise, paper, strict=False)  # the control has fewer trials
        pairs.append(np.array([(one.time_s, other.time_s) for one, other in same_starts]))
    rates = [(pair < _limit(runs)).astype(np.float64) for pair in pairs]
    rng = np.random.default_rng(0)
    slower = value_claim(
        "Noise alone takes longer than with the map's attractors: ratio of the median times, a "
        "trial that never arrived counting as its limit.",
        pairs,
        lambda values: median(values[:, 0]) / max(median(values[:, 1]), 1e-9),
        "at least",
        1.0,
        "times",
        rng,
        settings.resamples,
    )
    rarer = value_claim(
        f"Noise alone arrives too, in {np.mean(np.concatenate(rates)[:, 0]):.0%} of its trials; "
        "with the attractors more do (difference).",
        rates,
        lambda values: float(values[:, 1].mean() - values[:, 0].mean()),
        "at least",
        0.0,
        "share",
        rng,
        settings.resamples,
    )
    return [surely(slower), surely(rarer)]


def _corrected_aim(runs: Sequence[MapReaches], settings: Approaches) -> list[Claim]:
    aimed = by_map(runs, "corrected_aim")
    held = np.array([trial.held for trials in aimed for trial in trials])
    times = [np.array([trial.time_to_hold_s for trial in trials]) for trials in aimed]
    return [
        rate_claim("The corrected aim holds the same target.", held, settings.held),
        settings.median_claim(
            "It does so in this time (median).", times, "at most", settings.held_s, "s"
        ),
    ]


def _limit(runs: Sequence[MapReaches]) -> float:
    return min(trial.limit for trials in by_map(runs, "noise") for trial in trials)


def _ok(trials: Sequence[ReachedTrial]) -> Array:
    return np.array([trial.reached_s is not None for trial in trials], dtype=np.float64)
