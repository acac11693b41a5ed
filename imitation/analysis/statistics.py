"""How sure a number is: intervals for rates, and for whatever is measured over several maps."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array

NORMAL_97_5 = 1.959963984540054  # its 97.5 % point bounds a two-sided 95 % interval
RATE_SLACK = 0.03  # a rate is met when it lies surely above its bound less this


@dataclass(frozen=True)
class Interval:
    """A 95 % confidence interval."""

    low: float
    high: float


def wilson(successes: int, n: int) -> Interval:
    """Wilson's score interval of a rate of `successes` in `n` independent trials."""
    if n == 0:
        return Interval(0.0, 1.0)
    rate, z2 = successes / n, NORMAL_97_5**2
    centre = (rate + z2 / (2 * n)) / (1 + z2 / n)
    half = NORMAL_97_5 / (1 + z2 / n) * np.sqrt(rate * (1 - rate) / n + z2 / (4 * n**2))
    # At a rate of 0 or 1 the interval ends there; rounding would put its end beside it.
    low = 0.0 if successes == 0 else float(centre - half)
    return Interval(low, 1.0 if successes == n else float(centre + half))


def rate_is_met(successes: int, n: int, bound: float) -> bool:
    """Whether the lower end of the rate's Wilson interval lies above `bound` less 3 points."""
    return wilson(successes, n).low > bound - RATE_SLACK


def bootstrap(
    groups: Sequence[Array],
    statistic: Callable[[Array], float],
    rng: np.random.Generator,
    resamples: int,
) -> Interval:
    """Percentile interval of `statistic` over the pooled values of `groups`.

    Whole groups are drawn again, not values: trials on one map resemble each other, so many
    trials on few maps must not look like many maps.

    Args:
        groups: Values of each group (map or seed), (n_values,) each.
        statistic: Median, mean (a rate, of zeros and ones) or other of the pooled values.
        rng: Draws the groups.
        resamples: How often.
    """
    if not len(groups):
        return Interval(float("nan"), float("nan"))
    drawn = rng.integers(len(groups), size=(resamples, len(groups)))
    values = [statistic(np.concatenate([groups[group] for group in row])) for row in drawn]
    low, high = np.quantile(values, (0.025, 0.975))
    return Interval(float(low), float(high))
