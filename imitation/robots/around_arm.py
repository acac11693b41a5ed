"""What stands around an arm: the table under it, its own trunk, the head above it."""

from dataclasses import dataclass

import numpy as np

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
        points, trunk = np.split(followed, [len(self.radii)], axis=1)
        height = points[..., 2] - self.radii
        above, over = height - self.table_height, height - self.base_height
        away = np.hypot(points[..., 0] - self.base[0], points[..., 1] - self.base[1])
        beside = away - self.base_radius - self.radii
        below = np.linalg.norm(points - self.head, axis=-1) - self.head_radius - self.radii
        free = np.minimum(np.minimum(above, np.maximum(beside, over)), below).min(axis=1)
        between = np.linalg.norm(points[:, :, None] - trunk[:, None], axis=-1)
        room = between - self.radii[:, None] - self.trunk_radii
        own = room.min(axis=(1, 2), where=self.apart, initial=np.inf)
        return np.asarray(np.minimum(free, own))
