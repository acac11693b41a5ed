"""The stage of `imitate replay` made from the parts of a bench."""

from collections.abc import Iterator, Mapping

import numpy as np

from cli.build import Bench, generator
from cli.make import made_of
from imitation.arrivals import Arrivals, Noticing
from imitation.enacting import Arriving, Detours, Enactor
from imitation.grasp import GraspReflex
from imitation.precision import Precision, ToTheArea, ToTheSeenPlace
from imitation.recall import Recall
from imitation.recording.action_file import Action
from imitation.sample import Sample
from imitation.sequence import Replay
from imitation.stages.exploring import Wandering, explore
from imitation.stages.replay import Ending, replay
from imitation.visual_states import Resting
from imitation.visuo_motor_map import VisuoMotorMap

PRECISIONS: Mapping[str, type[Precision]] = {"area": ToTheArea, "seen": ToTheSeenPlace}


def replaying(
    bench: Bench, learned: VisuoMotorMap, action: Action
) -> tuple[Recall, Iterator[Sample]]:
    """What recalls the action, and the steps of its replay."""
    recall, perception = recalling(bench, learned, action), bench.perception(learned.field)
    enactor, ending = enacting(bench, learned), made_of(Ending, bench.cfg["replay"])
    return recall, replay(bench.robot, perception, recall, enactor, bench.dynamics, ending)


def recalling(bench: Bench, learned: VisuoMotorMap, action: Action) -> Recall:
    """What recalls the action when a hand is seen at one of its states."""
    cfg, field, sequence = bench.cfg, learned.field, bench.empty_sequence()
    for state in action.states:
        sequence.learn(state.area, state.time)
    resting, noticing = Resting(**cfg["states"]), Noticing(**cfg["arrivals"])
    own = learned.strangeness(bench.rest) < cfg["replay"]["own_hand"]
    arrivals = Arrivals(resting, noticing, field.reachable & own)
    loop, rng = Replay(sequence, bench.robot.period), generator(cfg["seed"], "sequence")
    places = [state.place for state in action.states]
    return Recall(places, loop, arrivals, field, cfg["sequence"]["noise"], rng)


def enacting(bench: Bench, learned: VisuoMotorMap) -> Enactor:
    """What the arm makes of states."""
    cfg, robot = bench.cfg, bench.robot
    precision = PRECISIONS[cfg["replay"]["precision"]]
    return Enactor(
        learned=learned,
        precision=made_of(precision, {**cfg["aim"], "period": robot.period}),
        reflex=reflex_of(bench),
        detours=detours_of(bench),
        arriving=Arriving(**cfg["arriving"]),
        rest=bench.rest,
        acceleration=robot.body.acceleration,
        period=robot.period,
    )


def reflex_of(bench: Bench) -> GraspReflex:
    """The reflex of the body's hand; without a gripper nothing is ever within its grasp."""
    settings = bench.cfg["robot"]["grasp"]
    return made_of(GraspReflex, settings) if settings else GraspReflex(0.0, 0.0, 0.0, 0.0)


def detours_of(bench: Bench) -> Detours:
    """The detours of the body's arm; none without a gripper."""
    settings, nowhere = bench.cfg["robot"]["grasp"], np.zeros_like(bench.rest)
    if settings is None:
        return Detours(nowhere, nowhere, nowhere, nowhere)
    return made_of(Detours, {name: np.array(value) for name, value in settings.items()})


def exploring(bench: Bench, learned: VisuoMotorMap, lasting: float) -> Iterator[Sample]:
    """As long a stay before the same things, without an action."""
    asked = bench.cfg["controls"]
    return explore(
        bench.robot,
        bench.perception(learned.field),
        learned,
        bench.dynamics,
        reflex_of(bench),
        detours_of(bench).lifted,
        bench.rest,
        Wandering(lasting, asked["noise_level"], asked["noise_steps"]),
        generator(bench.cfg["seed"], "noise"),
    )
