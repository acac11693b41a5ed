"""A live camera: its newest frame is decided on, and every frame is recorded."""

import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from imitation.arrays import Array
from imitation.device import DeviceError
from imitation.gaze import VisualSpace
from imitation.robot import Shot
from imitation.robots.frame_watch import FrameWatch, Taken
from imitation.robots.opencv_camera import Development
from imitation.robots.vision_watch import VisionWatch


class LiveCamera:
    """Delivers the newest frame of a device, a network stream, or a film shown as if it were one.

    Args:
        space: Visual space of the camera that it stands for.
        reference: The reference gaze, which its frames are taken to be seen with [rad].
        eye: Optical centre, (3,) [m].
        device: A number, a device, a URL or a film.
        latency: How long after its capture a frame comes [s].
        stale: A newest frame older than this is trouble [s].
        frozen: So are frames that have been equal for longer than this [s]; None: never.
        dark: So is one whose mean brightness is below this [0..255].
        lost: A camera that delivers nothing for this long has failed [s].
        aspect: What becomes of pictures of another shape: crop or fit.
        mirror: Whether left and right change places.
        quality: Of the JPEG [1..100].

    Raises:
        DeviceError: The device cannot be opened.
    """

    live = True

    def __init__(
        self,
        space: VisualSpace,
        reference: tuple[float, float],
        eye: Sequence[float],
        device: str | int,
        latency: float,
        stale: float,
        frozen: float | None,
        dark: float,
        lost: float,
        aspect: str,
        mirror: bool,
        quality: int,
    ) -> None:
        self._space, self._eye, self._device = space, np.asarray(eye), device
        self._develop = Development(space.size, reference, aspect, mirror, quality)
        self._fit = VisionWatch(stale, frozen, dark, lost)
        self._start_ns = 0  # when the run began, on the wall's clock
        self._watch = FrameWatch(device, self._develop, lost, latency)

    def reset(self, time_ns: int) -> None:
        """Wait for a frame of the episode that begins.

        Raises:
            DeviceError: None came.
        """
        if not self._start_ns:
            self._start_ns = time.monotonic_ns() - time_ns
        if not self._watch.wait_for_one_from(self._start_ns + time_ns, self._fit.lost):
            raise self._failed()

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """The newest frame, with those that came since the last look.

        Raises:
            DeviceError: Nothing came for too long.
        """
        ended = self._watch.ended
        taken = [one for one in self._watch.take() if one.time_ns >= self._start_ns]
        if taken:
            *skipped, self._newest = map(self._shot, taken)
            self._equal_since_ns = taken[-1].since_ns - self._start_ns
            return replace(self._newest, skipped=tuple(skipped), trouble=self._trouble(time_ns))
        if self._fit.is_lost(time_ns - self._newest.time_ns):
            raise self._failed()
        return replace(self._newest, trouble=self._trouble(time_ns), ended=ended)

    def locate(self, position: Array) -> Array:
        """Where a point of the world (3,) [m] lies in visual space, (2,) [px]."""
        return self._space.project(position, self._eye)

    def close(self) -> None:
        """Let go of the device; harmless when repeated."""
        self._watch.close()

    def _shot(self, taken: Taken) -> Shot:
        return self._develop.shot(taken.jpeg, taken.time_ns - self._start_ns)

    def _trouble(self, time_ns: int) -> str | None:
        newest, equal_ns = self._newest, time_ns - self._equal_since_ns
        return self._fit.trouble(newest.frame, time_ns - newest.time_ns, equal_ns)

    def _failed(self) -> DeviceError:
        return DeviceError(
            f"camera.device={self._device} delivered no frame for {self._fit.lost:g} s "
            "(camera.lost); is it still there, and does no other program use it?"
        )
