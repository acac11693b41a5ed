"""Stages made from the parts of a bench: their steps, to be recorded, watched or only counted."""

from collections.abc import Iterator, Sequence

import numpy as np

from cli.build import Bench, generator
from cli.make import made_of
from imitation.controllers.corrected_aim import CorrectedAim
from imitation.perception import Perception
from imitation.robots.hand_paths import Mirrored
from imitation.sample import Sample
from imitation.stages.babbling import Babbling, Curiosity
from imitation.stages.check_map import Visit, Visiting, check_map
from imitation.stages.demo_record import Watching, demo_record
from imitation.stages.draw import draw
from imitation.stages.learn_map import Learner, LearningRun, learn_map
from imitation.stages.mimic import mimic
from imitation.stages.reach import Reaching, Trial, reach
from imitation.visual_states import Resting, VisualStates
from imitation.visuo_motor_map import VisuoMotorMap


def learning(bench: Bench) -> tuple[Learner, Iterator[Sample]]:
    """Whoever learns, and the steps of its learning."""
    cfg, robot = bench.cfg, bench.robot
    rng = generator(cfg["seed"], "babbling")
    babbling = Babbling(bench.guided, Curiosity(**cfg["curiosity"]), robot.body.speed, rng)
    perception, settings = bench.perception(bench.field), LearningRun(**cfg["learning"])
    learner = Learner(robot, perception, bench.dynamics, bench.empty_map(), settings)
    return learner, learn_map(learner, babbling)


def reaching(bench: Bench, learned: VisuoMotorMap, trials: Sequence[Trial]) -> Iterator[Sample]:
    """The steps of the trials of a reach run."""
    perception = bench.perception(learned.field)
    return reach(
        bench.robot, perception, learned, bench.dynamics, bench.controller, trials, rules(bench)
    )


def rules(bench: Bench) -> Reaching:
    """When the trials of a reach run succeed and end."""
    return made_of(Reaching, bench.cfg["reach"])


def watching(bench: Bench) -> tuple[VisualStates, Iterator[Sample]]:
    """The states that will be found in a demonstration, and the steps of watching it."""
    cfg, states = bench.cfg, VisualStates(Resting(**bench.cfg["states"]), bench.field)
    settings, perception = made_of(Watching, cfg["demo"]), bench.perception(bench.field)
    return states, demo_record(
        bench.robot, perception, bench.dynamics, states, settings, bench.rest
    )


def checking(bench: Bench, learned: VisuoMotorMap) -> tuple[list[Visit], Iterator[Sample]]:
    """The postures that a check of a map visits, and the steps of visiting them."""
    cfg, (postures, places) = bench.cfg["check"], learned.memories()
    drawn = generator(bench.cfg["seed"], "check").permutation(len(postures))[: cfg["postures"]]
    visits = [Visit(postures[one], places[one]) for one in sorted(drawn)]
    visiting = made_of(Visiting, cfg)
    perception = bench.perception(learned.field)
    return visits, check_map(bench.robot, perception, bench.dynamics, visits, visiting)


def mimicking(bench: Bench, learned: VisuoMotorMap) -> Iterator[Sample]:
    """The steps of a mimic run."""
    perception, duration = bench.perception(learned.field), bench.cfg["duration"]
    if duration is None:
        film = "path" in bench.cfg["camera"]
        duration = np.inf if film else bench.cfg["mimic"]["endless"]
    return following(bench, learned, perception, duration)


def following(
    bench: Bench, learned: VisuoMotorMap, perception: Perception, duration: float
) -> Iterator[Sample]:
    """The steps of following what `perception` sees of a hand for `duration` [s]."""
    turning, selection = bench.cfg["mimic"]["turning"], bench.selection
    return mimic(bench.robot, perception, learned, bench.dynamics, selection, duration, turning)


def drawing(bench: Bench, learned: VisuoMotorMap) -> Iterator[Sample]:
    """The steps of drawing the line that the demonstrator's mirror is for."""
    perception, line = bench.perception(learned.field), mirror_of(bench).line
    controller, duration = bench.controller, bench.cfg["duration"]
    assert isinstance(controller, CorrectedAim)
    return draw(bench.robot, perception, learned, bench.dynamics, controller, line.at, duration)


def mirror_of(bench: Bench) -> Mirrored:
    """The mirror that experiment=mirror needs."""
    gesture = bench.demonstrator.gesture if bench.demonstrator else None
    if not isinstance(gesture, Mirrored):
        raise ValueError("experiment=mirror needs demonstrator=mirror; leave demonstrator= out")
    return gesture
