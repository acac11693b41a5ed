"""What the figures of reaching need before they are drawn: maps and reaches, seed by seed."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from cli.every_seed import on_every_seed
from cli.experiments import Experiment, learned_map, radius_of, reached
from imitation.analysis.fig4 import Trajectories, draw_fig4
from imitation.analysis.fig5 import draw_fig5
from imitation.analysis.fig5_claims import Approaches
from imitation.analysis.figure_style import Drawn
from imitation.analysis.reached import MapReaches, between_four, learned_positions


@dataclass(frozen=True)
class Other:
    """Another controller that reaches for the same target."""

    words: Sequence[str]  # what its reach run is told
    trials: int  # of them, from the first starts


@dataclass(frozen=True)
class Runs:
    """Runs of figs. 4 and 5; the YAML says what each means."""

    experiment: Experiment
    active: int
    average_px: float
    learned_trials: int
    between_trials: int


@dataclass(frozen=True)
class Fig4:
    """Runs and drawing of Fig. 4."""

    runs: Runs
    drawing: Trajectories


@dataclass(frozen=True)
class Fig5:
    """Runs and drawing of Fig. 5: those of Fig. 4, and other controllers beside it."""

    runs: Runs
    others: dict[str, Other]
    drawing: Approaches


def fig4(seeds: Sequence[int], settings: Fig4) -> Drawn:
    """Run and draw Fig. 4."""
    work = partial(reaches_of, settings=settings.runs, others={})
    runs = on_every_seed("fig4", work, seeds, settings.runs.experiment.workers)
    return draw_fig4(runs, settings.drawing)


def fig5(seeds: Sequence[int], settings: Fig5) -> Drawn:
    """Run and draw Fig. 5."""
    work = partial(reaches_of, settings=settings.runs, others=settings.others)
    runs = on_every_seed("fig5", work, seeds, settings.runs.experiment.workers)
    return draw_fig5(runs, settings.drawing)


def reaches_of(seed: int, settings: Runs, others: dict[str, Other]) -> MapReaches:
    """A map of its own for the seed, and all reaches with it."""
    experiment = settings.experiment
    learned = learned_map(seed, experiment)
    with experiment.reaching_bench(seed) as bench:
        radius = radius_of(bench, learned)
    at_learned = learned_positions(learned, radius, settings.active)
    reach = partial(reached, seed, learned)
    positions = reach(at_learned, settings.learned_trials, experiment)
    four = between_four(learned, radius, settings.average_px)
    if four is None:
        return MapReaches(learned, positions, None, {})
    [between] = reach([four], settings.between_trials, experiment)
    beside = {
        name: reach([four], other.trials, experiment, *other.words)[0]
        for name, other in others.items()
    }
    return MapReaches(learned, positions, between, beside)
