"""What is claimed of deferred imitation: order, grasp, place, time, triggers, another arm."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from imitation.analysis.claims import Claim, every_claim, reported, value_claim
from imitation.analysis.deferred import PLACED
from imitation.analysis.mimicry import frechet
from imitation.analysis.statistics import wilson
from imitation.analysis.triggers import Triggers
from imitation.arrays import Array


@dataclass(frozen=True)
class Deferred:
    """All that was run with one map and one demonstration."""

    told: Mapping[str, Mapping[str, Any]]  # of each condition: metrics
    paths: Mapping[str, Array]  # of each arm, empty-handed: the hand's way, (n, 2) [px]
    triggers: Triggers


@dataclass(frozen=True)
class Asked:
    """What is asked of the replays; the YAML says what each means."""

    grasped: float
    placed: float
    median_s: float
    largest_s: float
    clock: float
    tick_s: float
    frechet_points: int
    resamples: int


def claims_of_fig7(runs: Sequence[Deferred], asked: Asked) -> list[Claim]:
    """What is claimed of the replays."""
    seen = [run.told["seen"] for run in runs]
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
        *_of_triggers(runs),
        *_of_other_conditions(runs),
        *_of_both_arms(runs, asked),
    ]


def _of_other_conditions(runs: Sequence[Deferred]) -> list[Claim]:
    found = []
    for name in runs[0].told:
        if name == "seen":
            continue
        told = [run.told[name] for run in runs]
        found.append(every_claim(f"Order of the states: {name}.", _of(told, "order_correct")))
        placed = _placed(told)
        if name.startswith("without"):
            found.append(every_claim(f"Control: the can is not put there {name}.", 1.0 - placed))
        elif any(one["object_error_m"] is not None for one in told):
            near = f"The can stands within {100 * PLACED:g} cm of its goal: {name}."
            found.append(reported(_share(near, placed, 0.0)))
            grasped = _of(told, "grasped")
            found.append(reported(_share(f"The can is grasped: {name}.", grasped, 0.0)))
    return found


def _of_both_arms(runs: Sequence[Deferred], asked: Asked) -> list[Claim]:
    paths = [list(run.paths.values()) for run in runs if run.paths]
    if not paths:
        return []
    return [
        value_claim(
            "The other arm's hand keeps within an area's side of the Katana's path in visual "
            "space, both empty-handed (discrete Fréchet distance, largest).",
            [np.array([frechet(one, other, asked.frechet_points)]) for one, other in paths],
            lambda values: float(np.max(values)),
            "at most",
            runs[0].triggers.field.side,
            "px",
            np.random.default_rng(0),
            asked.resamples,
        )
    ]


def _of_triggers(runs: Sequence[Deferred]) -> list[Claim]:
    count = len(runs[0].triggers.probes)
    sentence = (
        "A hand triggers the action from the state in whose area it rests, and nowhere else "
        f"({count} places over the whole image on each map)."
    )
    return [every_claim(sentence, np.array([run.triggers.right == 1.0 for run in runs]))]


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
    """That this share of the seeds is so."""
    n, true = len(outcomes), int(outcomes.sum())
    interval, rate = wilson(true, n), true / n
    ends = interval.low, interval.high
    return Claim(sentence, "at least", bound, rate, *ends, n, "share", rate >= bound)
