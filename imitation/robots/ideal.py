"""A kinematic arm without an engine: it is where its commands lead, at once and exactly."""

from dataclasses import dataclass

import cv2
import numpy as np

from imitation.arrays import Array, Image
from imitation.gaze import VisualSpace, rotation
from imitation.robot import Body, JointReading
from imitation.robots.kinematic_chain import KinematicChain

TABLE = (158, 132, 102)  # colour of all that is not the hand, RGB
FINER = 8  # the hand is drawn this much finer, then shrunk, so that its centre is exact


class IdealArm:
    """An arm that obeys exactly.

    Args:
        body: Its joints and limits.
        chain: Where its mark is, as the first point.
        mark_radius: Radius of the mark on its hand [m].
        mark_colour: Its colour, red, green, blue [0..255].
    """

    live = False

    def __init__(
        self,
        body: Body,
        chain: KinematicChain,
        mark_radius: float,
        mark_colour: tuple[int, int, int],
    ) -> None:
        self.body, self._chain = body, chain
        self.scene = MarkOverTable(self, mark_radius, mark_colour)
        self._posture = (body.lower + body.upper) / 2
        self._velocity = np.zeros(len(body.lower))

    def reset(self, posture: Array) -> None:
        """Be at rest at `posture` [rad]."""
        self._posture, self._velocity = posture.copy(), np.zeros(len(posture))

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """Move with `velocity` [rad/s] for `period` [s]."""
        self._posture = self._posture + velocity * period
        self._velocity = velocity
        return velocity

    def read(self) -> JointReading:
        """Sense the joints."""
        return JointReading(self._posture, self._velocity)

    def mark_position(self) -> Array:
        """Centre of the mark on the hand, (3,) [m]."""
        return np.asarray(self._chain.positions(self._posture)[0])

    def truth(self) -> tuple[Array, Array | None]:
        """True position of the hand's mark [m]."""
        return self.mark_position(), None

    def close(self) -> None:
        """Nothing to release."""


@dataclass(frozen=True)
class MarkOverTable:
    """The mark of an ideal arm as a disc before a plain table."""

    arm: IdealArm
    radius: float  # [m]
    colour: tuple[int, int, int]

    def photograph(self, space: VisualSpace, eye: Array, gaze: Array) -> Image:
        """The picture from `eye` [m] along `gaze` [rad], RGB."""
        width, height = space.size
        picture = np.full((height, width, 3), TABLE, dtype=np.uint8)
        right, down, depth = rotation(gaze).T @ (self.arm.mark_position() - eye)
        if depth <= 0:
            return picture
        centre = np.array((right, down)) / depth * space.focal + space.centre
        radius = self.radius / depth * space.focal
        # Only the patch around the mark is drawn finely, then shrunk into the picture.
        low = np.maximum(np.floor(centre - radius - 1), 0).astype(int)
        high = np.minimum(np.ceil(centre + radius + 1), (width, height)).astype(int)
        if np.any(low >= high):
            return picture
        across, along = (high - low) * FINER
        patch = np.full((along, across, 3), TABLE, dtype=np.uint8)
        # Pixel centres lie at +0.5; OpenCV draws around pixel indices, here in 1/16 px.
        at = np.round(((centre - low) * FINER - 0.5) * 16).astype(int)
        size = round(radius * FINER * 16)
        cv2.circle(patch, (int(at[0]), int(at[1])), size, self.colour, -1, shift=4)
        small = cv2.resize(patch, (across // FINER, along // FINER), interpolation=cv2.INTER_AREA)
        picture[low[1] : high[1], low[0] : high[0]] = small
        return picture
