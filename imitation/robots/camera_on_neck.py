"""A camera that a neck of its own turns."""

from dataclasses import replace
from typing import Protocol

from imitation.arrays import Array
from imitation.robot import SECOND, Camera, Shot


class Neck(Protocol):
    """Turns a camera."""

    def wake(self) -> None:
        """Be ready to turn; harmless when repeated."""

    def turn(self, gaze: Array) -> None:
        """Turn to `gaze` (pan, tilt) [rad]; returns at once."""

    def gaze(self, ago: float) -> Array:
        """Pan and tilt, (2,) [rad], so many seconds ago."""

    def check(self) -> None:
        """Refuse to go on with a neck that has failed."""

    def close(self) -> None:
        """Release it; harmless when repeated."""


class CameraOnNeck:
    """A camera that a neck turns.

    Args:
        camera: What is turned.
        neck: What turns it.
    """

    def __init__(self, camera: Camera, neck: Neck) -> None:
        self._camera, self._neck = camera, neck
        self.live = True

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """Turn to `gaze` (as it is when None) and return the newest frame."""
        if gaze is not None:
            self._neck.turn(gaze)
        self._neck.check()
        shot = self._camera.look(time_ns, None)
        return replace(shot, gaze=self._neck.gaze((time_ns - shot.time_ns) / SECOND))

    def reset(self, time_ns: int) -> None:
        """Forget frames of the episode before; the first time, the neck wakes."""
        self._neck.wake()
        self._camera.reset(time_ns)

    def locate(self, position: Array) -> Array:
        """Where a point of the world [m] lies in visual space, (2,) [px]."""
        return self._camera.locate(position)

    def close(self) -> None:
        """Release camera and neck; harmless when repeated."""
        self._camera.close()
        self._neck.close()
