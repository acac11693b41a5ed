"""A kinematic arm without an engine: it is where its commands lead, at once and exactly."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import cv2
import numpy as np

from imitation.arrays import Array, Image
from imitation.gaze import VisualSpace, rotation
from imitation.robot import Body, JointReading
from imitation.robots.demonstrators import Hand, Shown
from imitation.robots.kinematic_chain import KinematicChain

TABLE = (158, 153, 140)  # colour of all that is not a hand, nor like skin, RGB
Pixel = tuple[int, int, int]  # red, green, blue [0..255]
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
        mark_colour: Pixel,
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


@dataclass
class MarkOverTable:
    """The mark of an ideal arm as a disc before a plain table; another's hand is one more."""

    arm: IdealArm
    radius: float  # [m]
    colour: Pixel
    _others: list[tuple[Array, float, Pixel]] = field(default_factory=list, init=False)
    _covered: bool = field(default=False, init=False)  # the arm's own mark

    def show(self, shown: Shown, hand: Hand) -> None:
        """Have a demonstrator's hand before the table, or none."""
        self._others, self._covered = [], shown.instead
        if shown.mark is not None:
            self._others = [(shown.mark, hand.radius, pixel(hand.colour))]

    def photograph(self, space: VisualSpace, eye: Array, gaze: Array) -> Image:
        """The picture from `eye` [m] along `gaze` [rad], RGB."""
        width, height = space.size
        picture = np.full((height, width, 3), TABLE, dtype=np.uint8)
        own = [] if self._covered else [(self.arm.mark_position(), self.radius, self.colour)]
        marks = [*own, *self._others]
        turn = rotation(gaze).T
        seen = [(turn @ (position - eye), radius, colour) for position, radius, colour in marks]
        for (right, down, depth), radius, colour in sorted(seen, key=lambda mark: -mark[0][2]):
            if depth > 0:
                centre = np.array((right, down)) / depth * space.focal + space.centre
                draw_disc(picture, centre, radius / depth * space.focal, colour)
        return picture


def pixel(colour: Sequence[float]) -> Pixel:
    """A colour's red, green, blue [0..1] as bytes."""
    red, green, blue = (round(255 * part) for part in colour[:3])
    return red, green, blue


def draw_disc(picture: Image, centre: Array, radius: float, colour: Pixel) -> None:
    """Draw a disc at `centre` (2,) with `radius`, both [px], into `picture`."""
    # Only the patch around it is drawn finely, then shrunk into the picture.
    low = np.maximum(np.floor(centre - radius - 1), 0).astype(int)
    high = np.minimum(np.ceil(centre + radius + 1), picture.shape[1::-1]).astype(int)
    if np.any(low >= high):
        return
    here = np.s_[low[1] : high[1], low[0] : high[0]]
    patch = picture[here].repeat(FINER, axis=0).repeat(FINER, axis=1)
    # Pixel centres lie at +0.5; OpenCV draws around pixel indices, here in 1/16 px.
    at = np.round(((centre - low) * FINER - 0.5) * 16).astype(int)
    cv2.circle(patch, (int(at[0]), int(at[1])), round(radius * FINER * 16), colour, -1, shift=4)
    across, along = high - low
    picture[here] = cv2.resize(patch, (across, along), interpolation=cv2.INTER_AREA)
