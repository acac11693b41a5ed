"""A can on the table of the PyBullet world: held by contact and friction alone."""

from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.robots.bullet.silence import silence

with silence():
    import pybullet

UPRIGHT = (0.0, 0.0, 0.0, 1.0)  # quaternion x, y, z, w


@dataclass(frozen=True)
class Can:
    """A full can.

    Args:
        radius: [m].
        height: [m].
        mass: [kg].
        friction: Lateral, without unit.
        spinning: Friction against turning on the spot [m].
        rolling: Friction against rolling [m].
        colour: Red, green, blue, opacity [0..1].
        centre: Where it stands at the beginning, (3,) [m].
    """

    radius: float
    height: float
    mass: float
    friction: float
    spinning: float
    rolling: float
    colour: tuple[float, float, float, float]
    centre: tuple[float, float, float]


class StandingCan:
    """A can in a world that was just built.

    Args:
        can: What it is.
        client: The engine.
    """

    def __init__(self, can: Can, client: int) -> None:
        self._can, self._client = can, client
        self._held: Array | None = None  # from the hand that carries it to its centre, (2,) [m]
        call = {"physicsClientId": client}
        shape = pybullet.createCollisionShape(
            pybullet.GEOM_CYLINDER, radius=can.radius, height=can.height, **call
        )
        look = pybullet.createVisualShape(
            pybullet.GEOM_CYLINDER,
            radius=can.radius,
            length=can.height,
            rgbaColor=can.colour,
            **call,
        )
        self.body: int = pybullet.createMultiBody(can.mass, shape, look, can.centre, **call)
        pybullet.changeDynamics(
            self.body,
            -1,
            lateralFriction=can.friction,
            spinningFriction=can.spinning,
            rollingFriction=can.rolling,
            restitution=0.0,
            **call,
        )

    def pose(self) -> Array:
        """Position of its centre [m] and quaternion x, y, z, w, (7,)."""
        position, turn = pybullet.getBasePositionAndOrientation(
            self.body, physicsClientId=self._client
        )
        return np.array((*position, *turn))

    def follow(self, hand: Array | None) -> None:
        """Stand below a demonstrator's `hand` (3,) [m] as it did when taken; None: let go."""
        if hand is None:
            self._held = None
            return
        if self._held is None:
            self._held = self.pose()[:2] - hand[:2]
        call = {"physicsClientId": self._client}
        x, y = (hand[:2] + self._held).tolist()
        place = (x, y, self._can.centre[2])
        pybullet.resetBasePositionAndOrientation(self.body, place, UPRIGHT, **call)
        pybullet.resetBaseVelocity(self.body, (0, 0, 0), (0, 0, 0), **call)
