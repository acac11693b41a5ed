"""How exactly a predicted state tells the arm where to go."""

from typing import Protocol

import numpy as np

from imitation.aim import Aim
from imitation.arrays import Array
from imitation.deciding import no_attractor, one_attractor
from imitation.visuo_motor_map import Attractors, VisuoMotorMap


class Precision(Protocol):
    """How exactly a predicted state tells where to go."""

    selection: Array  # V, (rows, columns)

    def begin(self, learned: VisuoMotorMap, target: Array) -> None:
        """A state whose place is `target` (2,) [px] is predicted."""

    def correct(self, posture: Array, hand: Array) -> None:
        """Take in that `posture` (n_joints,) [rad] showed the hand at `hand` (2,) [px]."""

    def attractors(self, posture: Array) -> Attractors:
        """What draws the arm; none where nothing was learned."""


class ToTheArea:
    """As in the paper: the posture learned for the state's area, with eyes closed."""

    def begin(self, learned: VisuoMotorMap, target: Array) -> None:
        """A state whose place is `target` (2,) [px] is predicted."""
        self._learned = learned
        self.selection = np.zeros(learned.field.shape)
        if area := learned.field.area_of(target):
            self.selection[area] = 1.0

    def correct(self, posture: Array, hand: Array) -> None:
        """Nothing is made of what is seen."""

    def attractors(self, posture: Array) -> Attractors:
        """The area's posture nearest to `posture` [rad]."""
        return self._learned.attractors(self.selection, posture)


class ToTheSeenPlace(Aim):
    """The place seen in the area: read out of the map, corrected by where the hand is seen."""

    def begin(self, learned: VisuoMotorMap, target: Array) -> None:
        """A state whose place is `target` (2,) [px] is predicted."""
        super().begin(learned, target)
        if learned.learned_area(target) is None:
            self.selection = np.zeros(learned.field.shape)

    def attractors(self, posture: Array) -> Attractors:
        """The aim, unless nothing was learned there."""
        if self.selection.any():
            return one_attractor(self.posture)
        return no_attractor(len(posture))
