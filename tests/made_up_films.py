"""Small films: a red disc that goes from left to right before a grey wall."""

from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np

GREY, RED = (128, 128, 128), (30, 30, 220)  # blue, green, red


def picture(x: float, size: tuple[int, int] = (320, 240)) -> np.ndarray:
    """A red disc at half height, `x` [share of the width]."""
    frame = np.full((size[1], size[0], 3), GREY, dtype=np.uint8)
    cv2.circle(frame, (round(x * size[0]), size[1] // 2), size[1] // 12, RED, -1)
    return frame


def film(
    path: Path, frames: int = 30, rate: float = 25.0, size=(320, 240), still=False, codec="mp4v"
) -> Path:
    """A film of the disc going from a quarter to three quarters of the width."""
    shares = np.zeros(frames) if still else np.linspace(0, 1, frames)
    return film_of(path, [picture(0.25 + 0.5 * share, size) for share in shares], rate, codec)


def film_of_an_action(path: Path) -> Path:
    """The disc rests at x = 55 px of 160 px, goes to 115 px, rests there, and goes on."""
    across = np.concatenate((np.full(25, 55), np.linspace(55, 115, 25), np.full(25, 115)))
    lower = 30  # than the middle, which is a border of areas [px]
    pictures = [np.roll(picture(x / 160), lower, axis=0) for x in [*across, *range(115, 200, 3)]]
    return film_of(path, pictures, 25.0, "mp4v")


def film_of(path: Path, pictures: Sequence[np.ndarray], rate: float, codec: str) -> Path:
    """A film that shows `pictures`."""
    size = pictures[0].shape[1::-1]
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*codec), rate, size)
    for one in pictures:
        writer.write(one)
    writer.release()
    return path
