"""A camera of a simulated world: on a neck, late and imprecise when asked to be."""

from collections import deque
from typing import Protocol

import numpy as np

from imitation.arrays import Array, Image
from imitation.gaze import VisualSpace
from imitation.robot import SECOND, Shot
from imitation.robots.demonstrators import Demonstrator, Hand, Shown


class Scene(Protocol):
    """What can be photographed."""

    def photograph(self, space: VisualSpace, eye: Array, gaze: Array) -> Image:
        """The picture from `eye` [m] along `gaze` [rad]."""

    def show(self, shown: Shown, hand: Hand) -> None:
        """Have a demonstrator's hand in it, or none."""


class SimulatedCamera:
    """Delivers each frame `delay_frames` steps after it was captured.

    Args:
        scene: What it looks at.
        space: Visual space of learning; its size and focal length are the camera's.
        eye: Optical centre, on the neck's axes, (3,) [m].
        gaze: Gaze at the start, pan and tilt, (2,) [rad].
        delay_frames: Steps from capture to delivery.
        noise_px: Standard deviation of the places seen in a frame [px].
        rng: Draws that noise.
        demonstrator: Who else has a hand in view; None: nobody.
    """

    live = False

    def __init__(
        self,
        scene: Scene,
        space: VisualSpace,
        eye: Array,
        gaze: Array,
        delay_frames: int,
        noise_px: float,
        rng: np.random.Generator,
        demonstrator: Demonstrator | None,
    ) -> None:
        self._scene, self.space, self._eye = scene, space, eye
        self._gaze, self._rng, self._noise_px = gaze, rng, noise_px
        self._demonstrator, self._began_ns = demonstrator, 0
        self._under_way: deque[Shot] = deque(maxlen=delay_frames + 1)

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """Turn to `gaze` (as it is when None), capture a frame, deliver the one that is due.

        The first frame of an episode is delivered until the delay has passed.
        """
        if gaze is not None:
            self._gaze = gaze
        if self._demonstrator:
            shown = self._demonstrator.at((time_ns - self._began_ns) / SECOND)
            self._scene.show(shown, self._demonstrator.hand)
        frame = self._scene.photograph(self.space, self._eye, self._gaze)
        noise = self._noise_px * self._rng.standard_normal(2)
        self._under_way.append(Shot(frame, time_ns, self._gaze, noise))
        return self._under_way[0]

    def reset(self, time_ns: int) -> None:
        """Forget the frames of the episode before."""
        self._began_ns = time_ns
        self._under_way.clear()

    def locate(self, position: Array) -> Array:
        """Where a point of the world (3,) [m] lies in visual space, (2,) [px]."""
        return self.space.project(position, self._eye)

    def close(self) -> None:
        """Nothing to release."""
