"""How well one path in visual space follows another: lag, distances, correlation.

Paths are (n, 2) [px], sampled once a control period at the same times; nan where nothing was seen.
"""

from collections.abc import Callable

import numpy as np

from imitation.arrays import Array

NOWHERE = float("nan")
MANY = 2000  # warping takes time and memory with the square of what is warped
Step = Callable[[Array, Array, Array, Array], Array]  # cost, from above, from left, diagonal


def both_known(one: Array, other: Array) -> tuple[Array, Array]:
    """The samples of two paths at which both are known."""
    known = ~(np.isnan(one[:, 0]) | np.isnan(other[:, 0]))
    return one[known], other[known]


def lag_steps(shown: Array, followed: Array, most: int) -> int:
    """By how many samples, 0..most, `followed` comes after `shown`: where the RMSE is least."""
    errors = [rmse(*lag_taken_out(shown, followed, lag)) for lag in range(most + 1)]
    known = np.where(np.isnan(errors), np.inf, errors)
    return int(known.argmin())


def lag_taken_out(shown: Array, followed: Array, lag: int) -> tuple[Array, Array]:
    """Both paths, each place shown beside the one that followed `lag` samples later."""
    if lag >= len(shown):
        return shown[:0], followed[:0]
    return shown[: len(shown) - lag], followed[lag:]


def rmse(one: Array, other: Array) -> float:
    """Root of the mean squared distance between places of the same time [px]."""
    one, other = both_known(one, other)
    return float(np.sqrt(np.mean(np.sum((one - other) ** 2, axis=1)))) if len(one) else NOWHERE


def correlation(one: Array, other: Array) -> float:
    """Sum over both axes of their covariance, over the root of the product of total variances.

    Defined on a straight line too, where one axis may not vary; nan when a path keeps still.
    """
    one, other = both_known(one, other)
    if not len(one):
        return NOWHERE
    apart, beside = one - one.mean(axis=0), other - other.mean(axis=0)
    total = np.sqrt(np.sum(apart**2) * np.sum(beside**2))
    return float(np.sum(apart * beside) / total) if total > 0 else NOWHERE


def dtw(one: Array, other: Array) -> float:
    """Dynamic time warping: mean distance along the best alignment [px].

    Symmetric steps (Sakoe and Chiba): a diagonal step counts twice, so that every alignment
    weighs n + m in all, by which the sum is divided. Paths of very many places are thinned out.
    """

    def step(cost: Array, above: Array, left: Array, diagonal: Array) -> Array:
        return np.minimum(np.minimum(above, left) + cost, diagonal + 2 * cost)

    one, other = _thinned(known(one)), _thinned(known(other))
    if not len(one) or not len(other):
        return NOWHERE
    return _best_alignment(one, other, step) / (len(one) + len(other))


def frechet(one: Array, other: Array, points: int) -> float:
    """Discrete Fréchet distance [px] of two paths of `points` places, evenly along their length."""

    def step(cost: Array, above: Array, left: Array, diagonal: Array) -> Array:
        return np.maximum(cost, np.minimum(np.minimum(above, left), diagonal))

    one, other = known(one), known(other)
    if not len(one) or not len(other):
        return NOWHERE
    return _best_alignment(evenly(one, points), evenly(other, points), step)


def known(path: Array) -> Array:
    """The samples of a path that are no nan."""
    return np.asarray(path[~np.isnan(path[:, 0])])


def _thinned(path: Array) -> Array:
    return path[:: -(-len(path) // MANY)] if len(path) else path


def evenly(path: Array, points: int) -> Array:
    """A path resampled at equal distances along its length, (points, 2)."""
    along = np.concatenate(((0.0,), np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))))
    at = np.linspace(0.0, along[-1], points)
    return np.column_stack([np.interp(at, along, axis) for axis in path.T])


def _best_alignment(one: Array, other: Array, step: Step) -> float:
    """What `step` makes of the way through all pairs of places, both paths only going on."""
    cost = np.linalg.norm(one[:, None] - other[None], axis=2)
    rows, columns = cost.shape
    total = np.full((rows + 1, columns + 1), np.inf)
    total[0, 0] = 0.0
    for diagonal in range(rows + columns - 1):
        i = np.arange(max(0, diagonal - columns + 1), min(rows, diagonal + 1))
        j = diagonal - i
        total[i + 1, j + 1] = step(cost[i, j], total[i, j + 1], total[i + 1, j], total[i, j])
    return float(total[-1, -1])


def jitter(path: Array, period: float, low: float, high: float) -> float:
    """Root mean square of what a path holds between `low` and `high` [Hz], both axes [px]."""
    path = known(path)
    if len(path) * period * (high - low) < 1:  # too short to resolve the band
        return NOWHERE
    window = np.hanning(len(path))[:, None]
    spectrum = np.fft.rfft((path - path.mean(axis=0)) * window, axis=0)
    frequency = np.fft.rfftfreq(len(path), period)
    within = (frequency >= low) & (frequency <= high)
    power = 2 * np.sum(np.abs(spectrum[within]) ** 2) / (len(path) * np.sum(window**2))
    return float(np.sqrt(power))
