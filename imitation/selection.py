"""Which attractors what is seen selects in mimicry, and how much (section III)."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from imitation.arrays import Array
from imitation.deciding import one_attractor
from imitation.perception import Percept
from imitation.visual_field import winner_take_all
from imitation.visuo_motor_map import Attractors, VisuoMotorMap


@dataclass(frozen=True)
class Selected:
    """What takes part."""

    selection: Array  # V, (rows, columns)
    attractors: Attractors  # at most one: the arm comes to rest there


class Selection(Protocol):
    """Chooses an attractor by what is seen."""

    def select(self, learned: VisuoMotorMap, percept: Percept, posture: Array) -> Selected:
        """What takes part when the arm is at `posture` (n_joints,) [rad]."""


@dataclass(frozen=True)
class Winner:
    """The paper's hard competition: the posture learned for the area that sees most of the hand."""

    def select(self, learned: VisuoMotorMap, percept: Percept, posture: Array) -> Selected:
        """What takes part when the arm is at `posture` (n_joints,) [rad]."""
        selection = winner_take_all(percept.visual_input)
        return Selected(selection, learned.attractors(selection, posture))


@dataclass(frozen=True)
class Soft:
    """The winner's neighbours take part too: the map, read between its places.

    Around the place where the hand is seen, posture is taken as linear in the place. The winner
    still decides whether the hand is where the arm has learned anything.

    Args:
        bandwidth: Of the regression from learned places to postures [area sides].
        ridge: Of the same [area sides squared].
    """

    bandwidth: float
    ridge: float

    def select(self, learned: VisuoMotorMap, percept: Percept, posture: Array) -> Selected:
        """What takes part when the arm is at `posture` (n_joints,) [rad]."""
        selection = winner_take_all(percept.visual_input)
        hand = percept.hand
        if hand is None or not (learned.learned & (selection > 0)).any():
            return Selected(selection, learned.attractors(selection, posture))
        read, _ = learned.read(hand, self.bandwidth, self.ridge)
        return Selected(
            self._weights(learned, hand),
            one_attractor(np.clip(read, learned.lower, learned.upper)),
        )

    def _weights(self, learned: VisuoMotorMap, hand: Array) -> Array:
        """How much each area weighs in the regression, (rows, columns); 1 in all."""
        off = np.linalg.norm(learned.places - hand, axis=-1) / (self.bandwidth * learned.field.side)
        weights = np.where(np.isnan(off), 0.0, np.exp(-(off**2) / 2)).sum(axis=-1)
        return np.asarray(weights / weights.sum())
