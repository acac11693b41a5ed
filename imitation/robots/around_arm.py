"""What stands around an arm: the table under it, its own trunk, the head above it."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from imitation.arrays import Array, Mask
from imitation.robots.kinematic_chain import KinematicChain


@dataclass(frozen=True)
class AroundArm:
    """How near the arm is to what it must not touch.

    Args:
        chain: Follows points of the arm and, after them, points of its trunk.
        radii: Size of the arm around each point of the arm, (n_points,) [m].
        trunk_radii: Size of the arm around each point of the trunk, (n_trunk,) [m].
        apart: Which of these must keep apart, (n_points, n_trunk).
        table_height: Height of the table's top [m].
        base: Centre of the arm's base on the ground, x and y (2,) [m].
        base_radius: Radius of the cylinder around the base [m].
        base_height: Its height [m].
        head: Where the camera is on its neck, (3,) [m].
        head_radius: Size of camera and neck around it [m].
    """

    chain: KinematicChain
    radii: Array
    trunk_radii: Array
    apart: Mask
    table_height: float
    base: Array
    base_radius: float
    base_height: float
    head: Array
    head_radius: float

    def clearance(self, postures: Array) -> Array:
        """Smallest distance of a guarded point's surface to any of them (n,) [m].

        Args:
            postures: (n, n_joints) [rad].
        """
        followed = self.chain.positions(postures)
        points, trunk = followed[:, : len(self.radii)], followed[:, len(self.radii) :]
        height = points[..., 2] - self.radii
        above, over = height - self.table_height, height - self.base_height
        away = np.hypot(points[..., 0] - self.base[0], points[..., 1] - self.base[1])
        beside = away - self.base_radius - self.radii
        below = _length(points - self.head) - self.head_radius - self.radii
        free = np.minimum(np.minimum(above, np.maximum(beside, over)), below).min(axis=1)
        one, other = self._pairs
        between = _length(points[:, one] - trunk[:, other])
        room = between - self.radii[one] - self.trunk_radii[other]
        return np.asarray(np.minimum(free, room.min(axis=1, initial=np.inf)))

    @cached_property
    def _pairs(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Which point must keep apart from which of the trunk, (n_pairs,) each."""
        one, other = np.nonzero(self.apart)
        return one, other


def _length(vectors: Array) -> Array:
    return np.asarray(np.sqrt(np.einsum("...i,...i", vectors, vectors)))
