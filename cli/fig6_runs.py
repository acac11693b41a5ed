"""What Fig. 6 needs before it is drawn: gestures followed, controls, the mirror, seed by seed."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain

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
from imitation.perception import Percept
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
    followed, smoothed = zip(*_followed(seed, settings, learned), strict=True)
    return Imitations(
        learned=learned,
        transition_s=fastest_transition(learned, Bench(controlled).body.acceleration),
        followed=followed,
        smoothed=list(chain(*smoothed)),
        correlation=run.correlation(),
        shuffled=np.array(shuffled),
        travelled={name: one.travelled() for name, one in alone.items()},
        mirror=mirrored(told("experiment=mirror"), learned),
    )


def _told(seed: int, settings: Fig6, *words: str) -> Config:
    return {**composed("mimic", "map=given", *settings.experiment.both, *words), "seed": seed}


def _followed(
    seed: int, settings: Fig6, learned: VisuoMotorMap
) -> Iterator[tuple[Followed, list[Smoothed]]]:
    """Every gesture followed, and what each time constant makes of the quick ones."""
    paces: tuple[tuple[float, float, Sequence[float]], ...] = (
        (settings.drawing.slow, settings.slow_duration, []),
        (settings.drawing.quick, settings.quick_duration, settings.taus),
    )
    for gesture in settings.gestures:
        for period, duration, taus in paces:
            lap = f"demonstrator={gesture}", f"demonstrator.period={period}", f"duration={duration}"
            percepts = None
            for selection in SELECTIONS:
                cfg = _told(seed, settings, *lap, f"selection={selection}")
                if percepts is None:
                    run, percepts = measured(cfg, learned)
                else:  # all see the same
                    [run] = seeing_the_same(cfg, learned, percepts, [learned])
                numbers = run.result(selection)
                followed = Followed(gesture, selection, period, numbers, *run.paths())
                yield followed, [_smoothed(cfg, learned, percepts, tau) for tau in taus]


def _smoothed(
    cfg: Config, learned: VisuoMotorMap, percepts: Sequence[Percept], tau: float
) -> Smoothed:
    slower = {**cfg, "dynamics": {**cfg["dynamics"], "tau": tau}}
    [run] = seeing_the_same(slower, learned, percepts, [learned])
    selection = cfg["selection"]["name"]
    numbers = run.result(selection)
    return Smoothed(selection, tau, numbers["lag_s"], numbers["jitter_px"])
