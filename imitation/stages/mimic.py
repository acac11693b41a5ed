"""Mimicry: what is seen and the arm's posture are kept in agreement (section III, fig. 6)."""

from collections.abc import Iterator

import numpy as np

from imitation.deciding import at_own_pace, drawn_by
from imitation.dynamics import Dynamics, homeostatic
from imitation.perception import Perception
from imitation.robot import Command, Robot
from imitation.sample import Sample
from imitation.selection import Selection
from imitation.visuo_motor_map import VisuoMotorMap


def mimic(
    robot: Robot,
    perception: Perception,
    learned: VisuoMotorMap,
    dynamics: Dynamics,
    selection: Selection,
    duration: float,
    turning: int,
) -> Iterator[Sample]:
    """Bring the arm to where vision says the hand is, for `duration` [s] or to the film's end.

    The neck turns to the reference gaze of visual space. Whose hand is seen there is not asked.
    So many first joints as `turning` says turn the whole arm about the vertical, at their own pace.
    """
    seen = robot.reset()
    begun, reference = seen.time, np.asarray(perception.space.reference)
    gain, level = homeostatic()
    before, acceleration = np.zeros(len(seen.posture)), robot.body.acceleration
    while seen.time - begun < duration and not seen.ended:
        percept = perception.perceive(seen)
        chosen = selection.select(learned, percept, seen.posture)
        decision = drawn_by(
            chosen.attractors, chosen.selection, seen.posture, dynamics, gain, level
        )
        decision = at_own_pace(decision, seen.posture, before, acceleration, robot.period, turning)
        command = Command(decision.velocity, gaze=reference)
        sensed, applied = robot.step(command)
        yield Sample(seen, percept, decision, command, applied)
        seen, before = sensed, applied.limited
