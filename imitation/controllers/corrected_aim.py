"""An attractor made of the neighbours' postures, its aim corrected by the error that is seen."""

from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.deciding import coming_to_rest, drawn_by, one_attractor
from imitation.dynamics import Dynamics, homeostatic
from imitation.pairing import PostureHistory
from imitation.perception import Percept
from imitation.regression import locally_linear
from imitation.robot import Observation
from imitation.sample import Decision
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass
class CorrectedAim:
    """One attractor between the learned ones, moved until the hand is seen at the target.

    Around the target, posture is taken as linear in the place it was seen at. That line, read
    backwards, says where each posture should show the hand; by how much it is seen elsewhere, in
    the frame taken at that posture, is the error of the aim.

    Args:
        bandwidth: Of the regression from learned places to postures [area sides].
        ridge: Of the same [area sides squared].
        settling: Time constant of the aim's error while the hand rests [s].
        noise: A movement this long between two frames halves the weight of those before [px].
        largest: The aim is moved by no more than this [px].
        acceleration: What each joint may brake with, (n_joints,) [rad/s^2].
        period: Control period [s].
    """

    bandwidth: float
    ridge: float
    settling: float
    noise: float
    largest: float
    acceleration: Array
    period: float

    keeps_correcting = True

    def begin(self, learned: VisuoMotorMap, target: Array) -> None:
        """A new trial towards `target` (2,) [px]."""
        side = learned.field.side
        postures, places = learned.memories()
        self._posture, self._slope = locally_linear(
            places, postures, target, self.bandwidth * side, self.ridge * side**2
        )
        self._reading = np.linalg.pinv(self._slope)  # (n_joints, 2): from postures to places
        self._selection = learned.field.within(target, self.bandwidth * side)
        self._history = PostureHistory(2.0)
        self._error: Array | None = None
        self._expected = target
        self._frame_ns = -1

    def decide(
        self, seen: Observation, percept: Percept, target: Array, dynamics: Dynamics
    ) -> Decision:
        """Where the arm is drawn now."""
        self._history.note(seen.time_ns, seen.posture)
        distance = float("nan")
        if percept.hand is not None:
            distance = float(np.linalg.norm(percept.hand - target))
            if percept.time_ns != self._frame_ns:
                self._correct(percept, percept.hand, target)
        goal = self._posture - self._aim() @ self._slope
        gain, level = homeostatic()
        decision = drawn_by(
            one_attractor(np.clip(goal, dynamics.lower, dynamics.upper)),
            self._selection,
            seen.posture,
            dynamics,
            gain,
            level,
            target=target,
            distance=distance,
        )
        return coming_to_rest(decision, seen.posture, self.acceleration, self.period)

    def _correct(self, percept: Percept, hand: Array, target: Array) -> None:
        posture = self._history.at(percept.time_ns)
        expected = target + (posture - self._posture) @ self._reading
        error = hand - expected
        if self._error is None:
            self._error = error
        else:
            # The faster the hand moves, the older grows what was seen before.
            moved = float(np.linalg.norm(expected - self._expected))
            rate = max(self.period / self.settling, moved / (moved + self.noise))
            self._error = self._error + rate * (error - self._error)
        self._expected = expected
        self._frame_ns = percept.time_ns

    def _aim(self) -> Array:
        """By how much the aim is off, (2,) [px]."""
        if self._error is None:
            return np.zeros(2)
        size = float(np.linalg.norm(self._error))
        return np.asarray(self._error * min(1.0, self.largest / max(size, 1e-9)))
