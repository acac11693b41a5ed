"""Pictures of the PyBullet world with the pixel convention of the bench."""

from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np

from imitation.arrays import Array, Image
from imitation.gaze import VisualSpace, rotation
from imitation.robots.bullet.world import World
from imitation.robots.demonstrators import Hand, Shown

# TinyRenderer draws what lies at continuous (u, v) into the pixel whose index is (u, v - 1),
# while our pixel centres are at +0.5: the picture is moved by the difference.
RENDERER_OFFSET = (-0.5, 0.5)  # x, y [px]
NEAR, FAR = 0.1, 4.0  # clipping planes [m]


def view_matrix(eye: Array, gaze: Array) -> Array:
    """OpenGL view matrix from `eye` [m] along `gaze` [rad], (16,) column-major."""
    right, down, forward = rotation(gaze).T
    rows = np.array((right, -down, -forward))
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rows, -rows @ eye
    return matrix.T.ravel()


@cache
def projection_matrix(space: VisualSpace) -> Array:
    """OpenGL projection matrix of a camera with `space`'s focal length and centre, (16,)."""
    (width, height), f = space.size, space.focal
    x, y = np.add(space.centre, RENDERER_OFFSET)
    matrix = np.zeros((4, 4))
    matrix[0, 0], matrix[0, 2] = 2 * f / width, 1 - 2 * x / width
    matrix[1, 1], matrix[1, 2] = 2 * f / height, 2 * y / height - 1
    matrix[2, 2], matrix[2, 3] = -(FAR + NEAR) / (FAR - NEAR), -2 * FAR * NEAR / (FAR - NEAR)
    matrix[3, 2] = -1
    return matrix.T.ravel()


@lru_cache(maxsize=1)  # the neck seldom moves
def _view_from(x: float, y: float, z: float, pan: float, tilt: float) -> Array:
    return view_matrix(np.array((x, y, z)), np.array((pan, tilt)))


@dataclass(frozen=True)
class BulletScene:
    """The PyBullet world as a camera sees it."""

    world: World

    def photograph(self, space: VisualSpace, eye: Array, gaze: Array) -> Image:
        """The picture from `eye` [m] along `gaze` [rad], RGB."""
        view = _view_from(*eye.tolist(), *gaze.tolist())
        return self.world.render(view, projection_matrix(space), space.size)

    def show(self, shown: Shown, hand: Hand) -> None:
        """Have a demonstrator's hand in the world, or none."""
        self.world.cover_mark(shown.instead)
        self.world.show_other(shown.mark, hand.radius, hand.colour)
        self.world.carry_can(shown.mark if shown.carrying else None)
