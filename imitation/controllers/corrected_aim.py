"""An attractor made of the neighbours' postures, its aim corrected by the error that is seen."""

import math
from dataclasses import dataclass

import numpy as np

from imitation.aim import Aim
from imitation.arrays import Array
from imitation.deciding import coming_to_rest, drawn_by, one_attractor
from imitation.dynamics import Dynamics, homeostatic
from imitation.pairing import PostureHistory
from imitation.perception import Percept
from imitation.robot import Observation
from imitation.sample import Decision
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass
class CorrectedAim(Aim):
    """One attractor between the learned ones, moved until the hand is seen at the target.

    A movement is paired with the frame that shows it.

    Args:
        acceleration: What each joint may brake with, (n_joints,) [rad/s^2].
    """

    acceleration: Array

    keeps_correcting = True

    def begin(self, learned: VisuoMotorMap, target: Array) -> None:
        """A new trial towards `target` (2,) [px]."""
        super().begin(learned, target)
        self._history = PostureHistory(2.0)
        self._frame_ns = -1

    def decide(
        self, seen: Observation, percept: Percept, target: Array, dynamics: Dynamics
    ) -> Decision:
        """Where the arm is drawn now."""
        self._history.note(seen.time_ns, seen.posture)
        distance = float("nan")
        if percept.hand is not None:
            distance = math.dist(percept.hand, target)
            if percept.time_ns != self._frame_ns:
                self.correct(self._history.at(percept.time_ns), percept.hand)
                self._frame_ns = percept.time_ns
        gain, level = homeostatic()
        decision = drawn_by(
            one_attractor(np.clip(self.posture, dynamics.lower, dynamics.upper)),
            self.selection,
            seen.posture,
            dynamics,
            gain,
            level,
            target=target,
            distance=distance,
        )
        return coming_to_rest(decision, seen.posture, self.acceleration, self.period)
