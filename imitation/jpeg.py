"""Frames as JPEG."""

import cv2
import numpy as np

from imitation.arrays import Image

# Colours at full resolution: by them the hand is found.
FULL = (cv2.IMWRITE_JPEG_SAMPLING_FACTOR, cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444)


def encoded(picture: Image, quality: int) -> bytes:
    """The JPEG of a picture as OpenCV has it, blue first; quality 1..100."""
    _, data = cv2.imencode(".jpg", picture, (cv2.IMWRITE_JPEG_QUALITY, quality, *FULL))
    return data.tobytes()


def decoded(jpeg: bytes) -> Image:
    """The picture that a JPEG holds, RGB.

    Raises:
        ValueError: It is damaged.
    """
    picture = cv2.imdecode(np.frombuffer(jpeg, dtype=np.uint8), cv2.IMREAD_COLOR_RGB)
    if picture is None:
        raise ValueError("a JPEG frame is damaged")
    return np.asarray(picture, dtype=np.uint8)
