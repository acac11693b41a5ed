"""The stage of `imitate replay` made from the parts of a bench."""

from collections.abc import Callable, Iterator
from functools import partial
from inspect import signature

import numpy as np

from cli.build import Bench, generator
from imitation.arrivals import Arrivals
from imitation.enacting import Arriving, Detours, Enactor
from imitation.grasp import GraspReflex
from imitation.precision import Precision, ToTheArea, ToTheSeenPlace
from imitation.recall import Recall
from imitation.recording.action_file import Action
from imitation.sample import Sample
from imitation.sequence import Replay
from imitation.stages.exploring import Wandering, explore
from imitation.stages.replay import Ending, replay
from imitation.visuo_motor_map import VisuoMotorMap

REFLEX = ("close_within", "firm", "closing", "opening")  # of robot.grasp
AIM = ("bandwidth", "ridge", "settling", "noise", "largest")  # of controller=corrected_aim


def replaying(
    bench: Bench, learned: VisuoMotorMap, action: Action
) -> tuple[Recall, Iterator[Sample]]:
    """What recalls the action, and the steps of its replay."""
    cfg, robot, field = bench.cfg, bench.robot, learned.field
    sequence = bench.empty_sequence()
    for state in action.states:
        sequence.learn(state.area, state.time)
    loop, arrivals = Replay(sequence, robot.period), Arrivals(**cfg["arrivals"])
    places = [state.place for state in action.states]
    rng = generator(cfg["seed"], "sequence")
    recall = Recall(places, loop, arrivals, field, cfg["sequence"]["noise"], rng)
    perception, enactor = bench.perception(field), enacting(bench, learned)
    ending = Ending(**{name: cfg["replay"][name] for name in signature(Ending).parameters})
    return recall, replay(robot, perception, recall, enactor, bench.dynamics, ending)


def enacting(bench: Bench, learned: VisuoMotorMap) -> Enactor:
    """What the arm makes of states."""
    cfg, robot = bench.cfg, bench.robot
    aim = {name: cfg["aim"][name] for name in AIM}
    precisions: dict[str, Callable[[], Precision]] = {
        "area": ToTheArea,
        "seen": partial(ToTheSeenPlace, **aim, period=robot.period),
    }
    return Enactor(
        learned=learned,
        precision=precisions[cfg["replay"]["precision"]](),
        reflex=reflex_of(bench),
        detours=detours_of(bench),
        arriving=Arriving(**cfg["arriving"]),
        rest=bench.rest,
        acceleration=robot.body.acceleration,
        period=robot.period,
    )


def reflex_of(bench: Bench) -> GraspReflex:
    """The reflex of the body's hand; without a gripper nothing is ever within its grasp."""
    settings = bench.cfg["robot"]["grasp"] or dict.fromkeys(REFLEX, 0.0)
    close_within, firm, closing, opening = (settings[name] for name in REFLEX)
    return GraspReflex(close_within, firm, closing, opening)


def detours_of(bench: Bench) -> Detours:
    """The detours of the body's arm; none without a gripper."""
    settings, asked = bench.cfg["robot"]["grasp"], signature(Detours).parameters
    nowhere = np.zeros_like(bench.rest)
    return Detours(**{name: np.array(settings[name]) if settings else nowhere for name in asked})


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
