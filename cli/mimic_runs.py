"""Mimic runs that are only measured: with other hands, with shuffled maps, before a mirror."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import closing
from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from cli.build import Bench, Config, generator
from cli.make import made_of
from cli.stages import drawing, following, mimicking, mirror_of
from imitation.analysis.mimic_metrics import Judging, MimicMetrics
from imitation.analysis.mirror import Aside, aside
from imitation.arrays import Array, Mask
from imitation.perception import Percept, Perception
from imitation.robot import SECOND, Observation
from imitation.robots.blind_camera import BlindCamera
from imitation.sample import Sample
from imitation.visuo_motor_map import VisuoMotorMap

Stage = Callable[[Bench, VisuoMotorMap], Iterator[Sample]]


def judged(bench: Bench, learned: VisuoMotorMap) -> MimicMetrics:
    """What will measure a mimic run of this bench."""
    shown, soft = bench.demonstrator, bench.cfg["selection"]["name"] == "soft"
    judging, place = made_of(Judging, bench.cfg["mimic"]), shown.place if shown else None
    return MimicMetrics(learned, place, soft, bench.robot.period, judging)


def measured(cfg: Config, learned: VisuoMotorMap) -> tuple[MimicMetrics, list[Percept]]:
    """A whole mimic run, measured, and what was seen in it."""
    bench, percepts = Bench(cfg), list[Percept]()
    with closing(bench.robot) as robot:
        metrics = judged(bench, learned)
        for sample in mimicking(bench, learned):
            percepts.append(sample.percept)
            metrics.add(sample, robot.truth())
    return metrics, percepts


@dataclass(frozen=True)
class Remembered(Perception):
    """Sees at each step what was seen at the same step of another run."""

    percepts: Iterator[Percept]

    def perceive(self, observation: Observation, attended: Mask | None = None) -> Percept:
        """What was seen then."""
        return replace(next(self.percepts), time_ns=observation.time_ns)


def seeing_the_same(
    cfg: Config,
    learned: VisuoMotorMap,
    percepts: Sequence[Percept],
    acting: Iterable[VisuoMotorMap],
) -> Iterator[MimicMetrics]:
    """Runs that see what was seen in another run, each acting by its own map.

    The arm, its engine and its guard are those of any run; so is what is seen, because with the
    own hand out of view it does not depend on what the arm does. Only pictures are not taken.

    Args:
        cfg: Of the runs.
        learned: The map by which they are measured.
        percepts: What was seen in the other run.
        acting: The map of each run.
    """
    bench = Bench(cfg)
    with closing(bench.robot) as robot:
        robot.camera = BlindCamera(robot.camera)
        duration = (len(percepts) - 0.5) * robot.period
        for one in acting:
            metrics, known = judged(bench, learned), bench.perception(learned.field)
            seeing = Remembered(**known.__dict__, percepts=iter(percepts))
            for sample in following(bench, one, seeing, duration):
                metrics.add(sample, robot.truth())
            yield metrics


def shuffled_correlations(
    numbers: Sequence[int], cfg: Config, learned: VisuoMotorMap, percepts: Sequence[Percept]
) -> list[float]:
    """Correlations of the robot's path with the demonstrated one when its map is shuffled.

    Args:
        numbers: Of the shuffled maps.
        cfg: Of the run.
        learned: Its map.
        percepts: What was seen in it.
    """
    seed = cfg["seed"]
    mixed = (shuffled(learned, generator(seed, f"shuffle {number}")) for number in numbers)
    return [run.correlation() for run in seeing_the_same(cfg, learned, percepts, mixed)]


def shuffled(learned: VisuoMotorMap, rng: np.random.Generator) -> VisuoMotorMap:
    """`learned` with what its clusters hold dealt out anew among the learned areas."""
    mixed = copy(learned)
    mixed.postures = learned.postures.copy()
    rows, columns = np.nonzero(learned.learned)
    dealt = rng.permutation(len(rows))
    mixed.postures[rows, columns] = learned.postures[rows[dealt], columns[dealt]]
    return mixed


def mirrored(cfg: Config, learned: VisuoMotorMap) -> list[Aside]:
    """What each deviation of the hand in the mirror does."""
    return [_aside(cfg, learned, deviation) for deviation in cfg["mirror"]["deviations"]]


def _aside(cfg: Config, learned: VisuoMotorMap, deviation: float) -> Aside:
    cfg = {**cfg, "demonstrator": {**cfg["demonstrator"], "deviation": deviation}}
    asked, mirror = cfg["mirror"], mirror_of(Bench(cfg))
    switch, window, to_the_side = mirror.switch, asked["window"], mirror.line.aside
    drawn, followed = _path(cfg, learned, drawing), _path(cfg, learned, mimicking)
    before = aside(*drawn, to_the_side, switch - window / 2, window)
    after = aside(*drawn, to_the_side, switch + asked["after"], window)
    there = aside(*followed, to_the_side, switch + asked["settled"], window)
    return Aside(deviation, after - before, there - float(mirror.line.ends[0] @ to_the_side))


def _path(cfg: Config, learned: VisuoMotorMap, stage: Stage) -> tuple[Array, Array]:
    """Times (n,) [s] and places of the true hand (n, 2) [px]."""
    bench, times, places = Bench(cfg), [], []
    with closing(bench.robot) as robot:
        for _ in stage(bench, learned):
            for truth in robot.truth():
                times.append(truth.time_ns / SECOND)
                places.append(truth.hand_px)
    return np.array(times), np.array(places)
