"""A posture aimed at a seen place: read out of the map, corrected by where the hand is seen."""

from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.visuo_motor_map import VisuoMotorMap


@dataclass
class Aim:
    """One posture between the learned ones, moved until the hand is seen at the target.

    Around the target, posture is taken as linear in the place it was seen at. That line, read
    backwards, says where each posture should show the hand; by how much it is seen elsewhere is
    the error of the aim.

    Args:
        bandwidth: Of the regression from learned places to postures [area sides].
        ridge: Of the same [area sides squared].
        settling: Time constant of the aim's error while the hand rests [s].
        noise: A movement this long between two frames halves the weight of those before [px].
        largest: The aim is moved by no more than this [px].
        period: Control period [s].
    """

    bandwidth: float
    ridge: float
    settling: float
    noise: float
    largest: float
    period: float

    def begin(self, learned: VisuoMotorMap, target: Array) -> None:
        """Aim at `target` (2,) [px], by the map alone."""
        self.move(learned, target)
        self._expected = target
        self._error: Array | None = None

    def move(self, learned: VisuoMotorMap, target: Array) -> None:
        """Aim at `target` (2,) [px], which has moved: what is known of the error stays."""
        self._posture, self._slope = learned.read(target, self.bandwidth, self.ridge)
        self._reading = np.linalg.pinv(self._slope)  # (n_joints, 2): from postures to places
        self.selection = learned.field.within(target, self.bandwidth * learned.field.side)  # V
        self._target = target

    def correct(self, posture: Array, hand: Array) -> None:
        """Take in that `posture` (n_joints,) [rad] showed the hand at `hand` (2,) [px]."""
        expected = self._target + (posture - self._posture) @ self._reading
        error = hand - expected
        if self._error is None:
            self._error = error
        else:
            # The faster the hand moves, the older grows what was seen before.
            moved = float(np.linalg.norm(expected - self._expected))
            resting = min(self.period / self.settling, 1.0)
            rate = max(resting, moved / (moved + self.noise))
            self._error = self._error + rate * (error - self._error)
        self._expected = expected

    @property
    def posture(self) -> Array:
        """Where the aim is now, (n_joints,) [rad]."""
        return np.asarray(self._posture - self._off() @ self._slope)

    def _off(self) -> Array:
        """By how much the aim is off, (2,) [px]."""
        if self._error is None:
            return np.zeros(2)
        size = float(np.linalg.norm(self._error))
        return np.asarray(self._error * min(1.0, self.largest / max(size, 1e-9)))
