"""Pictures read by OpenCV, brought into the visual space; what is seen is what is recorded."""

import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from imitation.arrays import Image
from imitation.jpeg import decoded, encoded
from imitation.robot import SECOND, Shot

# OpenCV and FFmpeg have words of their own for what we say in one line.
os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)


def cropped(picture: Image, size: tuple[int, int]) -> Image:
    """The largest centred part of `picture` that has the shape of `size`, scaled to it [px]."""
    height, width = picture.shape[:2]
    scale = max(size[0] / width, size[1] / height)
    across, along = (max(1, round(side / scale)) for side in size)
    left, top = (width - across) // 2, (height - along) // 2
    part = picture[top : top + along, left : left + across]
    return np.asarray(cv2.resize(part, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)


def framed(picture: Image, size: tuple[int, int]) -> Image:
    """The whole `picture` scaled into `size` [px], with black borders where it is too narrow."""
    height, width = picture.shape[:2]
    scale = min(size[0] / width, size[1] / height)
    across, along = (max(1, round(side * scale)) for side in (width, height))
    left, top = (size[0] - across) // 2, (size[1] - along) // 2
    whole = np.zeros((size[1], size[0], 3), dtype=np.uint8)
    small = cv2.resize(picture, (across, along), interpolation=cv2.INTER_AREA)
    whole[top : top + along, left : left + across] = small
    return whole


DAMAGED = 100  # so many pictures in a row that cannot be read are the end of a film
ASPECTS = {"crop": cropped, "fit": framed}


@dataclass(frozen=True)
class Development:
    """Makes frames of pictures: scaled to the visual space, encoded once as JPEG, and decoded.

    Args:
        size: Width and height of the visual space [px].
        gaze: What the pictures are taken to be seen with: the reference gaze, so that they are the
            visual space [rad].
        aspect: What becomes of a picture of another shape: crop or fit.
        mirror: Whether left and right change places.
        quality: Of the JPEG [1..100].
    """

    size: tuple[int, int]
    gaze: tuple[float, float]
    aspect: str
    mirror: bool
    quality: int

    def jpeg(self, picture: Image) -> bytes:
        """What is recorded of a picture as OpenCV reads it, blue first."""
        scaled = ASPECTS[self.aspect](picture, self.size)
        turned = cv2.flip(scaled, 1) if self.mirror else scaled
        return encoded(np.asarray(turned, dtype=np.uint8), self.quality)

    def shot(self, jpeg: bytes, time_ns: int) -> Shot:
        """What is seen of a recorded picture."""
        return Shot(decoded(jpeg), time_ns, np.array(self.gaze), jpeg=jpeg)


def pictures(film: Any, start: float, end: float | None) -> Iterator[tuple[int, Image]]:
    """Pictures of an opened film with their times since the first one [ns], always later ones.

    Args:
        film: A `cv2.VideoCapture` at its beginning.
        start: Presentation time to begin at [s].
        end: Presentation time to end at [s]; None: where the film ends.
    """
    rate = film.get(cv2.CAP_PROP_FPS)
    usual = round(SECOND / rate) if rate > 0 else 1  # where the film does not tell a time
    first, last = None, -usual
    while True:
        picture = _next_readable(film)
        shown = film.get(cv2.CAP_PROP_POS_MSEC) / 1000
        if picture is None or (end is not None and shown >= end):
            return
        if shown < start:
            continue
        first = shown if first is None else first
        at = round((shown - first) * SECOND)
        last = at if at > last else last + usual
        yield last, picture


def _next_readable(film: Any) -> Image | None:
    """The next picture that is not damaged; None at the end of the film."""
    for _ in range(DAMAGED):
        there, picture = film.read()
        if there:
            return np.asarray(picture, dtype=np.uint8)
    return None
