"""A film in the place of a camera: its frames come by its own clock, in the run's time."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path

import cv2
import numpy as np

from imitation.arrays import Array
from imitation.gaze import VisualSpace
from imitation.robot import Shot
from imitation.robots.film_file import missing_bytes
from imitation.robots.opencv_camera import Development, pictures


class FilmCamera:
    """Delivers, at each step, the newest frame of a film that has been shown by then.

    Args:
        space: Visual space of the camera that the film stands for.
        reference: The reference gaze, which the film is taken to be seen with [rad].
        eye: Optical centre of that camera, (3,) [m].
        path: The film.
        start: Presentation time to begin at [s].
        end: Presentation time to end at [s]; None: where the film ends.
        aspect: What becomes of pictures of another shape: crop or fit.
        mirror: Whether left and right change places.
        quality: Of the JPEG [1..100].

    Raises:
        ValueError: There is no whole film at `path`, or fewer than two pictures of it are shown
            between `start` and `end`.
    """

    live = False

    def __init__(
        self,
        space: VisualSpace,
        reference: tuple[float, float],
        eye: Sequence[float],
        path: str,
        start: float,
        end: float | None,
        aspect: str,
        mirror: bool,
        quality: int,
    ) -> None:
        self._space, self._eye, self._path = space, np.asarray(eye), Path(path).expanduser()
        self._develop = Development(space.size, reference, aspect, mirror, quality)
        self._start, self._end = start, end
        self._film = cv2.VideoCapture()
        if not self._path.is_file():
            raise ValueError(f"no film at camera.path={path}; type camera.path=FILM")
        if missing := missing_bytes(self._path):
            raise ValueError(
                f"camera.path={path} is cut short: {missing} bytes or more are missing at its end; "
                "give the whole film"
            )
        self.reset(0)

    def reset(self, time_ns: int) -> None:
        """The film begins now."""
        self._film.open(str(self._path), cv2.CAP_FFMPEG)
        self._coming = self._shots(time_ns)
        first, second = next(self._coming, None), next(self._coming, None)
        if first is None or second is None:
            raise ValueError(self._why_it_is_no_film(first))
        self._newest: Shot = first
        self._next: Shot | None = first
        self._coming = chain((second,), self._coming)

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        """The newest frame shown by now, with those shown since the last look."""
        passed: list[Shot] = []
        while self._next is not None and self._next.time_ns <= time_ns:
            passed.append(self._next)
            self._next = next(self._coming, None)
        if not passed:
            return replace(self._newest, ended=self._next is None)
        *skipped, self._newest = passed
        return replace(self._newest, skipped=tuple(skipped))

    def locate(self, position: Array) -> Array:
        """Where a point of the world (3,) [m] lies in visual space, (2,) [px]."""
        return self._space.project(position, self._eye)

    def close(self) -> None:
        """Close the film; harmless when repeated."""
        self._film.release()

    def _shots(self, began_ns: int) -> Iterator[Shot]:
        for shown_ns, picture in pictures(self._film, self._start, self._end):
            yield self._develop.shot(self._develop.jpeg(picture), began_ns + shown_ns)

    def _why_it_is_no_film(self, only: Shot | None) -> str:
        named = f"camera.path={self._path}"
        if not self._film.isOpened():
            return f"{named} is no film that OpenCV can read; type camera.path=FILM"
        holds = "nothing" if only is None else "a single picture"
        if not self._start and self._end is None:
            return f"{named} shows {holds}; type camera.path=FILM"
        end = "null" if self._end is None else f"{self._end:g}"
        return f"{named} shows {holds} from camera.start={self._start:g} to camera.end={end} s"
