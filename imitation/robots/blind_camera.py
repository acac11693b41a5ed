"""A camera with a lid on: for runs in which it is known already what is to be seen."""

import numpy as np

from imitation.arrays import Array
from imitation.robot import Camera, Shot

DARK = np.zeros((1, 1, 3), dtype=np.uint8)


class BlindCamera:
    """Takes no picture, so that a step costs little.

    Args:
        camera: In whose place it is.
    """

    live = False

    def __init__(self, camera: Camera) -> None:
        self._camera = camera

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """Nothing, at once."""
        return Shot(DARK, time_ns, np.zeros(2))

    def reset(self, time_ns: int) -> None:
        """There is nothing to forget."""

    def locate(self, position: Array) -> Array:
        """Where a point of the world [m] lies in visual space, (2,) [px]."""
        return self._camera.locate(position)

    def close(self) -> None:
        """Release the camera; harmless when repeated."""
        self._camera.close()
