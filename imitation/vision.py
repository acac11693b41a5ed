"""What of a frame is the hand: everything of its colour, own or other's."""

from dataclasses import dataclass

import cv2
import numpy as np

from imitation.arrays import Array, Image, Mask

HUES = 180  # OpenCV's hue circle has 180 steps of 2 degrees


@dataclass(frozen=True)
class ColourDetector:
    """Finds the pixels of one colour.

    Args:
        hue: Lowest and highest hue [0..179]; lowest > highest closes the circle through red.
        saturation: Lowest and highest saturation [0..255].
        value: Lowest and highest brightness [0..255].
        min_pixels: Fewer pixels than this are no hand.
    """

    hue: tuple[int, int]
    saturation: tuple[int, int]
    value: tuple[int, int]
    min_pixels: int

    def __post_init__(self) -> None:
        for name, (low, high), top in (
            ("hue", self.hue, HUES - 1),
            ("saturation", self.saturation, 255),
            ("value", self.value, 255),
        ):
            if not (0 <= low <= top and 0 <= high <= top):
                raise ValueError(f"vision.{name} must lie in 0..{top}, got [{low}, {high}]")
            if name != "hue" and low > high:
                raise ValueError(f"vision.{name} is [low, high], got [{low}, {high}]; swap them")

    def mask(self, frame: Image) -> Mask:
        """Pixels of the hand's colour in `frame`, (height, width)."""
        hsv = cv2.cvtColor(frame, cv2.COLOR_RGB2HSV)
        low, high = self.hue
        floor, ceiling = (self.saturation[0], self.value[0]), (self.saturation[1], self.value[1])
        if low <= high:
            found = cv2.inRange(hsv, (low, *floor), (high, *ceiling))
        else:  # Red closes the hue circle, so it is both ends of OpenCV's 0..179.
            found = cv2.bitwise_or(
                cv2.inRange(hsv, (low, *floor), (HUES - 1, *ceiling)),
                cv2.inRange(hsv, (0, *floor), (high, *ceiling)),
            )
        return np.asarray(found, dtype=bool)

    def hand_pixels(self, frame: Image) -> Array:
        """Centres of the hand's pixels, (n, 2) [px], pixel centres at +0.5; n = 0 when unseen."""
        found = cv2.findNonZero(self.mask(frame).view(np.uint8))
        if found is None or len(found) < self.min_pixels:
            return np.empty((0, 2))
        return found.reshape(-1, 2).astype(np.float64) + 0.5
