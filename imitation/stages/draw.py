"""Drawing a straight line while watching what is taken for the own hand (Nielsen, section III)."""

from collections.abc import Callable, Iterator

from imitation.arrays import Array
from imitation.controllers.corrected_aim import CorrectedAim
from imitation.dynamics import Dynamics
from imitation.perception import Perception
from imitation.robot import Command, Robot
from imitation.sample import Sample
from imitation.visuo_motor_map import VisuoMotorMap


def draw(
    robot: Robot,
    perception: Perception,
    learned: VisuoMotorMap,
    dynamics: Dynamics,
    controller: CorrectedAim,
    line: Callable[[float], Array],
    duration: float,
) -> Iterator[Sample]:
    """Reach for a target that moves along `line`, (2,) [px] of a time [s], for `duration` [s]."""
    seen = robot.reset()
    begun = seen.time
    controller.begin(learned, line(0.0))
    while (now := seen.time - begun) < duration:
        target = line(now)
        controller.move(learned, target)
        percept = perception.perceive(seen)
        decision = controller.decide(seen, percept, target, dynamics)
        command = Command(decision.velocity)
        sensed, applied = robot.step(command)
        yield Sample(seen, percept, decision, command, applied)
        seen = sensed
