"""What is claimed of mimicry: following, lag, controls, the mirror."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from imitation.analysis.claims import Claim, every_claim, reported, value_claim
from imitation.analysis.imitations import Imitations
from imitation.analysis.mirror import corrects_against, follows, grows
from imitation.arrays import Array

REPORTED = (  # number of metrics.json, what it is, unit
    ("correlation", "Correlation of the two paths", ""),
    ("dtw_px", "Mean distance after dynamic time warping", "px"),
    ("frechet_px", "Discrete Fréchet distance", "px"),
    ("jitter_px", "Jitter at 2 to 3 Hz", "px"),
    ("follow_rate", "Visits followed", "share"),
)
Number = Callable[[Imitations], Array]  # values of one map, (n,)


@dataclass(frozen=True)
class Mimicking:
    """Settings of Fig. 6; its YAML says what each means."""

    slow: float
    quick: float
    follow_rate: float
    above_floor_px: float
    soft_px: float
    lag_s: float
    still_px: float
    quantile: float
    mirrored: float
    resamples: int

    def median(
        self, sentence: str, runs: Sequence[Imitations], number: Number, bound: float, unit: str
    ) -> Claim:
        """That the median over all maps is at most `bound`."""
        return self._claim(sentence, runs, number, np.median, "at most", bound, unit)

    def mean(
        self, sentence: str, runs: Sequence[Imitations], number: Number, least: float
    ) -> Claim:
        """That the mean share over all maps is at least `least`."""
        return self._claim(sentence, runs, number, np.mean, "at least", least, "share")

    def told(self, sentence: str, runs: Sequence[Imitations], number: Number, unit: str) -> Claim:
        """What the median over all maps is; nothing is asked of it."""
        return reported(self.median(sentence, runs, number, np.inf, unit))

    def _claim(
        self,
        sentence: str,
        runs: Sequence[Imitations],
        number: Number,
        statistic: Callable[[Array], np.floating],
        comparison: Literal["at least", "at most"],
        bound: float,
        unit: str,
    ) -> Claim:
        groups = [number(run) for run in runs]
        return value_claim(
            sentence,
            groups,
            lambda values: float(statistic(values)),
            comparison,
            bound,
            unit,
            np.random.default_rng(0),
            self.resamples,
        )


def claims_of_fig6(runs: Sequence[Imitations], settings: Mimicking) -> list[Claim]:
    """What is claimed over all maps."""
    return [
        *_following(runs, settings),
        *_distances(runs, settings),
        *_lags(runs, settings),
        *_controls(runs, settings),
        *_mirror(runs, settings),
        *_reports(runs, settings),
    ]


def numbers(key: str, selection: str, period: float) -> Number:
    """One number of metrics.json for each gesture of this period and selection."""
    return lambda run: np.array([one.told[key] for one in run.of(selection, period)], dtype=float)


def _following(runs: Sequence[Imitations], settings: Mimicking) -> list[Claim]:
    return [
        settings.mean(
            f"The areas that the hand visits are followed, {settings.slow:g} s a gesture, "
            f"selection={selection} (mean over gestures).",
            runs,
            numbers("follow_rate", selection, settings.slow),
            settings.follow_rate,
        )
        for selection in ("winner", "soft")
    ]


def _distances(runs: Sequence[Imitations], settings: Mimicking) -> list[Claim]:
    found = []
    for period in (settings.slow, settings.quick):
        rmse = {one: numbers("path_rmse_px", one, period) for one in ("winner", "soft")}
        floor = numbers("floor_rmse_px", "winner", period)
        at = f"{period:g} s a gesture"
        found.append(
            settings.median(
                f"After the lag the winner's path is as near as its areas allow, {at} (RMSE less "
                "its floor, median).",
                runs,
                lambda run, rmse=rmse, floor=floor: rmse["winner"](run) - floor(run),  # type: ignore[misc]
                settings.above_floor_px,
                "px",
            )
        )
        found.append(
            settings.median(
                f"Soft selection follows between the areas, {at} (RMSE after the lag, median).",
                runs,
                rmse["soft"],
                settings.soft_px,
                "px",
            )
        )
    return [*found, *(_halved(runs, at) for at in (settings.slow, settings.quick))]


def _halved(runs: Sequence[Imitations], period: float) -> Claim:
    soft, winner = (numbers("path_rmse_px", one, period) for one in ("soft", "winner"))
    return every_claim(
        "Soft selection halves the winner's distance, or better, on the same map "
        f"({period:g} s, mean RMSE over gestures).",
        np.array([soft(run).mean() <= winner(run).mean() / 2 for run in runs]),
    )


def _lags(runs: Sequence[Imitations], settings: Mimicking) -> list[Claim]:
    asked = [
        settings.median(
            f"{name} lags no more than a human follower, {period:g} s a gesture (median).",
            runs,
            numbers("lag_s", selection, period),
            settings.lag_s,
            "s",
        )
        for selection, name in (("soft", "Soft selection"), ("winner", "The winner"))
        for period in (settings.slow, settings.quick)
    ]
    half = settings.told(
        "Half the time that all joints together take from one learned posture to the next, as "
        "fast as their acceleration allows (median).",
        runs,
        lambda run: np.array([run.transition_s / 2]),
        "s",
    )
    return [*asked, half]


def _reports(runs: Sequence[Imitations], settings: Mimicking) -> list[Claim]:
    """What is asked of nobody, of each selection at each pace."""
    return [
        settings.told(
            f"{name}, selection={selection}, {period:g} s a gesture (median).",
            runs,
            numbers(key, selection, period),
            unit,
        )
        for key, name, unit in REPORTED
        for selection in ("winner", "soft")
        for period in (settings.slow, settings.quick)
    ]


def _controls(runs: Sequence[Imitations], settings: Mimicking) -> list[Claim]:
    null = np.concatenate([run.shuffled for run in runs])
    bound = float(np.quantile(null, settings.quantile))
    still = [
        settings.median(
            f"The arm stays where it is: {name} (largest distance, median).",
            runs,
            lambda run, name=name: np.array([run.travelled[name]]),  # type: ignore[misc]
            settings.still_px,
            "px",
        )
        for name in runs[0].travelled
    ]
    return [
        *still,
        every_claim(
            f"The path is correlated with the demonstrated one beyond {settings.quantile:.0%} of "
            f"{len(null)} shuffled maps ({bound:.2f}).",
            np.array([run.correlation > bound for run in runs]),
        ),
    ]


def _mirror(runs: Sequence[Imitations], settings: Mimicking) -> list[Claim]:
    told = (
        (
            "Before the mirror the drawing arm goes to the other side than the hand.",
            corrects_against,
        ),
        ("It goes farther aside the more the hand deviates.", grows),
        ("The arm that keeps vision and posture in agreement goes to the same side.", follows),
    )
    return [
        settings.mean(
            sentence,
            runs,
            lambda run, true=true: np.array([float(true(run.mirror))]),  # type: ignore[misc]
            settings.mirrored,
        )
        for sentence, true in told
    ]
