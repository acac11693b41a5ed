"""Runs that figures are made of: learn a map, reach with it; nothing is recorded."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache

import numpy as np
from hydra import compose, initialize_config_module
from hydra.core.global_hydra import GlobalHydra

from cli.build import Bench, Config, generator
from cli.check import checked
from cli.installed_bodies import search_path
from cli.stages import learning, reaching, rules
from imitation.analysis.reached import ReachedTrial, Reaches, Situation
from imitation.arrays import Array
from imitation.sample import Sample
from imitation.stages.reach import Trial
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass(frozen=True)
class Experiment:
    """What the runs behind a figure are told, as words after their commands."""

    both: Sequence[str]  # learn-map and reach
    learning: Sequence[str]  # learn-map alone
    reaching: Sequence[str]  # reach alone
    workers: int  # runs at a time

    @contextmanager
    def learning_bench(self, seed: int) -> Iterator[Bench]:
        """The parts of a learn-map run, closed at the end."""
        yield from _opened("learn-map", seed, *self.both, *self.learning)

    @contextmanager
    def reaching_bench(self, seed: int, *more: str) -> Iterator[Bench]:
        """The parts of a reach run told `more` words, closed at the end."""
        yield from _opened("reach", seed, "map=given", *self.both, *self.reaching, *more)


@cache
def composed(command: str, *words: str, own: tuple[str, ...] = ()) -> Config:
    """A command's configuration with `words` typed after it, checked; the same for all seeds.

    Args:
        command: Such as learn-map.
        words: As they are typed.
        own: Places with configurations of the user's own, as Hydra writes them.
    """
    name, words = command.replace("-", "_"), (*search_path(*own), *words)
    if GlobalHydra.instance().is_initialized():
        return checked(command, compose(name, list(words)))
    with initialize_config_module("conf", version_base="1.3"):
        return checked(command, compose(name, list(words)))


def learned_map(seed: int, experiment: Experiment) -> VisuoMotorMap:
    """The map of a learn-map run."""
    with experiment.learning_bench(seed) as bench:
        learner, samples = learning(bench)
        for _ in samples:
            pass
    return learner.learned


def trials_for(seed: int, learned: VisuoMotorMap, target: Array, count: int) -> list[Trial]:
    """Trials from different learned postures, none of them the one seen nearest to `target`."""
    postures, places = learned.memories()
    nearest = np.argmin(np.linalg.norm(places - target, axis=1))
    others = np.delete(np.arange(len(postures)), nearest)
    drawn = np.resize(generator(seed, "starts").permutation(others), count)
    return [Trial(target, postures[one]) for one in drawn]


def reached(
    seed: int,
    learned: VisuoMotorMap,
    situations: Sequence[Situation],
    count: int,
    experiment: Experiment,
    *words: str,
) -> tuple[Reaches, ...]:
    """Reaches for the target of each situation, the same starts whatever the controller.

    Args:
        seed: Of the run.
        learned: The map.
        situations: What to reach for.
        count: Trials for each target.
        experiment: What the run is told.
        words: More of that, such as the controller.
    """
    trials = [trial for one in situations for trial in trials_for(seed, learned, one.target, count)]
    with experiment.reaching_bench(seed, *words) as bench:
        found = followed(reaching(bench, learned, trials), rules(bench).limit)
    return tuple(
        Reaches(one, tuple(found[i * count : (i + 1) * count])) for i, one in enumerate(situations)
    )


def radius_of(bench: Bench, learned: VisuoMotorMap) -> float:
    """Attractors of areas centred nearer than this to the target take part in reaching [px]."""
    return float(bench.cfg["controller"]["radius"] * learned.field.side)


def followed(samples: Iterator[Sample], limit: float) -> list[ReachedTrial]:
    """The trials of a reach run, each of which ends after `limit` seconds."""
    found: list[ReachedTrial] = []
    for sample in samples:
        if any(event.kind == "episode" for event in sample.events):
            found.append(ReachedTrial(limit))
        found[-1].add(sample)
    return found


def _opened(command: str, seed: int, *words: str) -> Iterator[Bench]:
    bench = Bench({**composed(command, *words), "seed": seed})
    try:
        yield bench
    finally:
        bench.robot.close()
