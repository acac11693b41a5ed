"""What the paper claims, beside what was measured: NAME.claims.json."""

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np

from imitation.analysis.statistics import bootstrap, rate_is_met, wilson
from imitation.arrays import Array
from imitation.recording.json_file import write_json


@dataclass(frozen=True)
class Claim:
    """One claim of the paper as a sentence, and whether it came true here; or a mere report."""

    sentence: str
    comparison: Literal["at least", "at most", "reported"]  # how it must compare with `asked`
    asked: float  # nan of a report
    measured: float  # over all seeds
    low: float  # ends of the 95 % confidence interval of `measured`
    high: float
    n: int  # independent trials, or groups of them, behind `measured`
    unit: str
    passed: bool


def rate_claim(sentence: str, outcomes: Array, bound: float) -> Claim:
    """That at least `bound` of independent `outcomes` (n,), ones and zeros, are true.

    It passes when the lower end of the rate's interval lies above the bound less 3 points.
    """
    n, successes = len(outcomes), int(np.count_nonzero(outcomes))
    rate, interval = successes / n if n else math.nan, wilson(successes, n)
    passed = rate_is_met(successes, n, bound)
    return Claim(sentence, "at least", bound, rate, interval.low, interval.high, n, "share", passed)


def every_claim(sentence: str, outcomes: Array) -> Claim:
    """That all of the independent `outcomes` (n,), ones and zeros, are true, without exception."""
    n, successes = len(outcomes), int(np.count_nonzero(outcomes))
    rate, interval = successes / n if n else math.nan, wilson(successes, n)
    passed = successes == n > 0
    return Claim(sentence, "at least", 1.0, rate, interval.low, interval.high, n, "share", passed)


def value_claim(
    sentence: str,
    groups: Sequence[Array],
    statistic: Callable[[Array], float],
    comparison: Literal["at least", "at most"],
    bound: float,
    unit: str,
    rng: np.random.Generator,
    resamples: int,
) -> Claim:
    """That a statistic of all groups' values keeps to a bound, with its bootstrap interval.

    Args:
        sentence: The claim.
        groups: Values measured in each group (map or seed), (n_values,) each.
        statistic: Median, mean or other of the pooled values.
        comparison: On which side of the bound the statistic must lie.
        bound: The value asked for.
        unit: Of bound and values.
        rng: Draws the groups of the bootstrap.
        resamples: How often.
    """
    measured = statistic(np.concatenate(groups)) if len(groups) else math.nan
    interval = bootstrap(groups, statistic, rng, resamples)
    passed = measured >= bound if comparison == "at least" else measured <= bound
    return Claim(
        sentence,
        comparison,
        bound,
        float(measured),
        interval.low,
        interval.high,
        len(groups),
        unit,
        bool(passed),
    )


def surely(claim: Claim) -> Claim:
    """`claim`, come true only when the whole interval keeps to the bound."""
    if claim.comparison == "at least":
        return replace(claim, passed=bool(claim.low >= claim.asked))
    return replace(claim, passed=bool(claim.high <= claim.asked))


def reported(claim: Claim) -> Claim:
    """`claim` as a report: told beside the others, nothing is asked of it."""
    return replace(claim, comparison="reported", asked=math.nan, passed=True)


def write_claims(
    folder: Path, figure: str, claims: Sequence[Claim], seeds: int, demo: bool
) -> Path:
    """Write NAME.claims.json into `folder`; what is no number becomes null.

    Args:
        folder: Where the figure lies.
        figure: Its name, such as fig3a.
        claims: What it claims.
        seeds: How many seeds were run.
        demo: Whether it shows a few seeds only, too few to judge by.
    """
    content = {
        "figure": figure,
        "demo": demo,
        "seeds": seeds,
        "claims": [asdict(one) for one in claims if one.comparison != "reported"],
        "reports": [_report(one) for one in claims if one.comparison == "reported"],
    }
    path = folder / f"{figure}.claims.json"
    write_json(path, content)
    return path


def _report(claim: Claim) -> dict[str, Any]:
    asking = ("comparison", "asked", "passed")
    return {key: value for key, value in asdict(claim).items() if key not in asking}
