"""The table of the PyBullet world: something to stand on, and something to see."""

from dataclasses import dataclass

from imitation.robots.bullet.silence import silence

with silence():
    import pybullet


@dataclass(frozen=True)
class Table:
    """A box to work on."""

    size: tuple[float, float, float]  # x, y, z [m]
    centre: tuple[float, float, float]  # of the box [m]
    colour: tuple[float, float, float, float]  # red, green, blue, opacity [0..1]
    friction: float  # lateral, without unit

    @property
    def height(self) -> float:
        """Height of the table's top [m]."""
        return self.centre[2] + self.size[2] / 2


def add_solid(table: Table, client: int) -> None:
    """Put a table that is felt into the world of `client`."""
    call = {"physicsClientId": client}
    half = [side / 2 for side in table.size]
    shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, **call)
    # Without a visual shape PyBullet would draw the collision shape.
    speck = pybullet.createVisualShape(pybullet.GEOM_SPHERE, radius=0.001, **call)
    body = pybullet.createMultiBody(0, shape, speck, table.centre, **call)
    pybullet.changeDynamics(body, -1, lateralFriction=table.friction, restitution=0.0, **call)


def add_seen(table: Table, client: int) -> None:
    """Put a table that is seen into the world of `client`."""
    call = {"physicsClientId": client}
    half = [side / 2 for side in table.size]
    shape = pybullet.createVisualShape(
        pybullet.GEOM_BOX, halfExtents=half, rgbaColor=table.colour, **call
    )
    pybullet.createMultiBody(0, -1, shape, table.centre, **call)
