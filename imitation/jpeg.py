"""Frames as the JPEG that a recording keeps."""

import cv2
import numpy as np

from imitation.arrays import Image


def decoded(jpeg: bytes) -> Image:
    """The picture that a JPEG holds, RGB.

    Raises:
        ValueError: It is damaged.
    """
    picture = cv2.imdecode(np.frombuffer(jpeg, dtype=np.uint8), cv2.IMREAD_COLOR_RGB)
    if picture is None:
        raise ValueError("a JPEG frame is damaged")
    return np.asarray(picture, dtype=np.uint8)
