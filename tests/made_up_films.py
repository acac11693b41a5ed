"""Small films: a red disc that goes from left to right before a grey wall."""

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
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*codec), rate, size)
    for number in range(frames):
        share = 0.0 if still else number / max(frames - 1, 1)
        writer.write(picture(0.25 + 0.5 * share, size))
    writer.release()
    return path
