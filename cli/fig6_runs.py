"""What Fig. 6 needs before it is drawn: gestures followed, controls, the mirror, seed by seed."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from cli.build import Bench, Config
from cli.every_seed import on_every_seed
from cli.experiments import Experiment, composed, learned_map
from cli.jobs.mimic_controls import without
from cli.mimic_runs import measured, mirrored, seeing_the_same, shuffled_correlations
from imitation.analysis.fig6 import draw_fig6
from imitation.analysis.fig6_claims import Mimicking
from imitation.analysis.figure_style import Drawn
from imitation.analysis.imitations import Followed, Imitations, Smoothed, fastest_transition
from imitation.analysis.mimic_metrics import MimicMetrics
from imitation.visuo_motor_map import VisuoMotorMap

SELECTIONS = ("winner", "soft")


@dataclass(frozen=True)
class Fig6:
    """Runs and drawing of Fig. 6; its YAML says what each means."""

    experiment: Experiment
    gestures: Sequence[str]
    slow_duration: float
    quick_duration: float
    taus: Sequence[float]
    smoothed: Sequence[str]
    controlled: Sequence[str]
    shuffles: int
    drawing: Mimicking


def fig6(seeds: Sequence[int], settings: Fig6) -> Drawn:
    """Run and draw Fig. 6."""
    work = partial(imitations, settings=settings)
    runs = on_every_seed("fig6", work, seeds, settings.experiment.workers)
    return draw_fig6(runs, settings.drawing)


def imitations(seed: int, settings: Fig6) -> Imitations:
    """A map of its own for the seed, and all that is run with it."""
    learned = learned_map(seed, settings.experiment)
    told = partial(_told, seed, settings)
    controlled = told("experiment=mimicry_controls", *settings.controlled)
    run, percepts = measured(controlled, learned)
    shuffled = shuffled_correlations(range(settings.shuffles), controlled, learned, percepts)
    alone = {name: measured(cfg, learned)[0] for name, cfg in without(controlled).items()}
    return Imitations(
        learned=learned,
        transition_s=fastest_transition(learned, Bench(controlled).body.acceleration),
        followed=list(_followed(seed, settings, learned)),
        smoothed=list(_smoothed(seed, settings, learned)),
        correlation=run.correlation(),
        shuffled=np.array(shuffled),
        travelled={name: one.travelled() for name, one in alone.items()},
        mirror=mirrored(told("experiment=mirror"), learned),
    )


def _told(seed: int, settings: Fig6, *words: str) -> Config:
    return {**composed("mimic", "map=given", *settings.experiment.both, *words), "seed": seed}


def _followed(seed: int, settings: Fig6, learned: VisuoMotorMap) -> Iterator[Followed]:
    paces = (
        (settings.drawing.slow, settings.slow_duration),
        (settings.drawing.quick, settings.quick_duration),
    )
    for gesture in settings.gestures:
        for period, duration in paces:
            told = partial(
                _told,
                seed,
                settings,
                f"demonstrator={gesture}",
                f"demonstrator.period={period}",
                f"duration={duration}",
            )
            for selection, run in _of_each_selection(told, learned):
                yield Followed(gesture, selection, period, run.result(selection), *run.paths())


def _smoothed(seed: int, settings: Fig6, learned: VisuoMotorMap) -> Iterator[Smoothed]:
    for tau in settings.taus:
        told = partial(_told, seed, settings, f"dynamics.tau={tau}", *settings.smoothed)
        for selection, run in _of_each_selection(told, learned):
            numbers = run.result(selection)
            yield Smoothed(selection, tau, numbers["lag_s"], numbers["jitter_px"])


def _of_each_selection(
    told: Callable[..., Config], learned: VisuoMotorMap
) -> Iterator[tuple[str, MimicMetrics]]:
    """The same run by each selection; all see the same."""
    first, *others = SELECTIONS
    run, percepts = measured(told(f"selection={first}"), learned)
    yield first, run
    for selection in others:
        cfg = told(f"selection={selection}")
        [again] = seeing_the_same(cfg, learned, percepts, [learned])
        yield selection, again
