"""Visual space: the image as it would be if the camera looked along the reference gaze."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from imitation.arrays import Array


def rotation(gaze: Array) -> Array:
    """Camera axes at `gaze` (pan, tilt) [rad], (3, 3); columns: right, down, forward.

    World axes: x ahead, y left, z up. Pan turns left, tilt turns up.
    """
    (sin_pan, sin_tilt), (cos_pan, cos_tilt) = np.sin(gaze), np.cos(gaze)
    right = (sin_pan, -cos_pan, 0.0)
    down = (sin_tilt * cos_pan, sin_tilt * sin_pan, -cos_tilt)
    forward = (cos_tilt * cos_pan, cos_tilt * sin_pan, sin_tilt)
    return np.array((right, down, forward)).T


@dataclass(frozen=True)
class VisualSpace:
    """The image plane at the reference gaze, (width, height) [px].

    The projection between gazes is exact for a camera that turns about its optical centre.
    """

    size: tuple[int, int]  # width, height [px]
    focal: float  # focal length [px]
    centre: tuple[float, float]  # where the optical axis meets the image [px]
    reference: tuple[float, float]  # pan, tilt of the reference gaze [rad]

    @cached_property
    def _turn(self) -> Array:
        """Rotation from the world's axes to those of the reference gaze, (3, 3)."""
        return rotation(np.asarray(self.reference)).T

    def to_visual_space(self, points: Array, gaze: Array) -> Array:
        """Image `points` (n, 2) [px] of a camera at `gaze` [rad], in visual space (n, 2) [px].

        A point behind the reference image plane becomes nan.
        """
        if tuple(gaze) == self.reference:
            return points
        rays = np.column_stack(((points - self.centre) / self.focal, np.ones(len(points))))
        turn = self._turn @ rotation(np.asarray(gaze))
        x, y, depth = turn @ rays.T
        depth = np.where(depth > 0, depth, np.nan)
        return np.column_stack((x / depth, y / depth)) * self.focal + self.centre

    def project(self, position: Array, eye: Array) -> Array:
        """Where a world point (3,) [m], seen from `eye` [m], lies in visual space (2,) [px].

        A point behind the camera becomes nan.
        """
        right, down, forward = self._turn @ (position - eye)
        depth = forward if forward > 0 else np.nan
        return np.array((right / depth, down / depth)) * self.focal + self.centre

    def unproject(self, place: Array, eye: Array, height: float) -> Array:
        """The world point (3,) [m] at `height` [m] that `eye` [m] sees at `place` (2,) [px].

        A place whose ray does not lead to that height becomes nan.
        """
        ray = self._turn.T @ np.append((place - np.array(self.centre)) / self.focal, 1.0)
        along = (height - eye[2]) / ray[2] if ray[2] else -1.0
        return np.asarray(eye + ray * (along if along > 0 else np.nan))
