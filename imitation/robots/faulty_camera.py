"""Simulated cameras that fail for a while, and are watched then as a real one always is."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from imitation.arrays import Array
from imitation.device import DeviceError
from imitation.robot import SECOND, Camera, Shot
from imitation.robots.faults import lasting
from imitation.robots.spoilt_pictures import SPOILT
from imitation.robots.vision_watch import VisionWatch


class FaultyCamera:
    """Stands before a camera.

    Args:
        camera: What is spoilt.
        name: Of the fault.
        at: It begins so long after the run did [s].
        lasts: For so long [s]; None: until the end.
    """

    live = False

    def __init__(self, camera: Camera, name: str, at: float, lasts: float | None) -> None:
        self._camera, self._fault = camera, lasting(name, at, lasts)

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """Turn to `gaze` (as it is when None) and return the newest frame."""
        return self._camera.look(time_ns, gaze)

    def reset(self, time_ns: int) -> None:
        """Forget frames of the episode before."""
        self._camera.reset(time_ns)

    def locate(self, position: Array) -> Array:
        """Where a point of the world [m] lies in visual space, (2,) [px]."""
        return self._camera.locate(position)

    def close(self) -> None:
        """Release the camera; harmless when repeated."""
        self._camera.close()


class SilentNeck(FaultyCamera):
    """A camera on a neck that does not answer."""

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """The same; it is an error while the neck is silent."""
        if self._fault.lasts(time_ns / SECOND):
            raise DeviceError("the neck is silent: check its power and its cable")
        return super().look(time_ns, gaze)


class SpoiltCamera(FaultyCamera):
    """A camera whose pictures are wrong, or do not come.

    Args:
        camera: What is spoilt.
        name: Of the fault.
        at: It begins so long after the run did [s].
        lasts: For so long [s]; None: until the end.
        watch: Arguments of `VisionWatch`.
    """

    def __init__(
        self, camera: Camera, name: str, at: float, lasts: float | None, watch: Mapping[str, Any]
    ) -> None:
        super().__init__(camera, name, at, lasts)
        self._watch = VisionWatch(**watch)
        self._sound: Shot | None = None  # the last one before the fault
        self._sound_ns = 0  # when it came

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """What the fault leaves of the newest frame; an error when it has left none too long."""
        shot = super().look(time_ns, gaze)
        if self._sound is None or not self._fault.lasts(time_ns / SECOND):
            self._sound, self._sound_ns = shot, time_ns
            return shot
        shown, since = self._spoilt(shot, self._sound), time_ns - self._sound_ns
        age = since if shown is self._sound else 0
        equal = since if shown.frame is self._sound.frame else 0
        if self._watch.is_lost(age):
            raise DeviceError(
                f"the camera delivered no frame for {self._watch.lost:g} s (fault.watch.lost)"
            )
        return replace(shown, trouble=self._watch.trouble(shown.frame, age, equal))

    def _spoilt(self, shot: Shot, sound: Shot) -> Shot:
        if self._fault.name == "camera_gone":
            return sound
        if self._fault.name == "camera_frozen":
            return replace(sound, time_ns=shot.time_ns, gaze=shot.gaze)
        return replace(shot, frame=SPOILT[self._fault.name](shot.frame))
