"""The control that uses one learned posture: the one seen nearest to the target."""

from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.deciding import coming_to_rest, drawn_by
from imitation.dynamics import Dynamics, homeostatic
from imitation.perception import Percept
from imitation.robot import Observation
from imitation.sample import Decision
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass
class Nearest:
    """The homeostatic controller on the single area learned nearest to the target.

    Args:
        acceleration: What each joint may brake with, (n_joints,) [rad/s^2]: without braking in
            time the arm would swing about the posture for seconds.
        period: Control period [s].
    """

    acceleration: Array
    period: float

    keeps_correcting = True

    def begin(self, learned: VisuoMotorMap, target: Array) -> None:
        """A new trial towards `target` (2,) [px]."""
        self._learned = learned
        self._selection = np.zeros(learned.field.shape)
        self._selection.flat[learned.distances(target).argmin()] = 1.0

    def decide(
        self, seen: Observation, percept: Percept, target: Array, dynamics: Dynamics
    ) -> Decision:
        """Where the arm is drawn now."""
        gain, level = homeostatic()
        attractors = self._learned.attractors(self._selection, seen.posture)
        off = float("nan") if percept.hand is None else np.linalg.norm(percept.hand - target)
        decision = drawn_by(
            attractors,
            self._selection,
            seen.posture,
            dynamics,
            gain,
            level,
            target=target,
            distance=float(off),
        )
        return coming_to_rest(decision, seen.posture, self.acceleration, self.period)
