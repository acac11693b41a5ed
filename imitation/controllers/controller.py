"""What a controller of reaching is."""

from typing import Protocol

from imitation.arrays import Array
from imitation.dynamics import Dynamics
from imitation.perception import Percept
from imitation.robot import Observation
from imitation.sample import Decision
from imitation.visuo_motor_map import VisuoMotorMap


class Controller(Protocol):
    """Draws the arm to a target, one decision a step."""

    keeps_correcting: bool  # at the target too; else the stage stops the arm there

    def begin(self, learned: VisuoMotorMap, target: Array) -> None:
        """A new trial towards `target` (2,) [px]."""

    def decide(
        self, seen: Observation, percept: Percept, target: Array, dynamics: Dynamics
    ) -> Decision:
        """Where the arm is drawn now."""
