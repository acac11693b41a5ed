"""Demonstrations and replays that figures and experiments are made of; nothing is recorded."""

from collections.abc import Callable, Iterator

from cli.build import Bench, Config
from cli.experiments import composed
from cli.jobs.replay import deferred_metrics
from cli.replaying import replaying
from cli.stages import watching
from imitation.analysis.deferred import DeferredMetrics
from imitation.recording.action_file import Action
from imitation.sample import Sample
from imitation.visuo_motor_map import VisuoMotorMap

Look = Callable[[Sample, Bench], None]
Stage = Callable[[Bench], Iterator[Sample]]


def demonstrated(seed: int, *words: str, look: Look | None = None) -> Action:
    """The action that a demo-record run learns.

    Args:
        seed: Of the run.
        words: What it is told.
        look: Is shown each step and the bench.
    """
    bench = Bench({**composed("demo-record", *words), "seed": seed})
    states, samples = watching(bench)
    for sample in samples:
        if look:
            look(sample, bench)
    bench.robot.close()
    return Action.watched(bench.field, states.states, bench.cfg["demo"]["margin"])


def replayed(
    seed: int, learned: VisuoMotorMap, action: Action, *words: str, look: Look | None = None
) -> DeferredMetrics:
    """What is measured of a replay run; for the arguments see `demonstrated`."""
    cfg = {**composed("replay", "map=given", "action=given", *words), "seed": seed}
    return judged(cfg, learned, action, lambda bench: replaying(bench, learned, action)[1], look)


def judged(
    cfg: Config, learned: VisuoMotorMap, shown: Action, stage: Stage, look: Look | None = None
) -> DeferredMetrics:
    """What is measured of a stage's steps when `shown` was to be imitated."""
    bench = Bench(cfg)
    metrics = deferred_metrics(bench, learned, shown)
    for sample in stage(bench):
        metrics.add(sample, bench.robot.truth())
        if look:
            look(sample, bench)
    bench.robot.close()
    return metrics
