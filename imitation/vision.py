"""What of a frame is the hand: all that has its colour, or all that moves; own or other's."""

from collections import deque
from dataclasses import dataclass, field

import cv2
import numpy as np

from imitation.arrays import Array, Image, Mask
from imitation.robot import SECOND, Observation

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
        return _centres(self.mask(frame), self.min_pixels)

    def hand_in(self, seen: Observation) -> Array:
        """The same in what is seen at a step."""
        return self.hand_pixels(seen.frame)


@dataclass(frozen=True)
class HandDetector(ColourDetector):
    """Finds the large patches of one colour, and of an arm that reaches in, only its hand.

    Args:
        least_patch: A connected patch smaller than this share of the largest is a speck [0..1].
        most: One larger than this share of the picture is no hand, but a wall or a table [0..1].
        length: Of a hand. Of a patch that comes in by an edge of the picture, what lies farther
            than this from its other end is forearm [px]; None: forearms count.
    """

    least_patch: float
    most: float
    length: float | None

    def mask(self, frame: Image) -> Mask:
        """Pixels of the hand in `frame`, without specks, walls and forearms, (height, width)."""
        found = super().mask(frame)
        count, patches, told, _ = cv2.connectedComponentsWithStats(found.view(np.uint8))
        sizes = told[:, cv2.CC_STAT_AREA]
        sizes[0] = 0  # all that was not found
        sizes[sizes > self.most * found.size] = 0
        hands = np.zeros_like(found)
        for number in range(1, count):
            if sizes[number] and sizes[number] >= self.least_patch * sizes.max():
                hands |= self._hand_of(patches == number)
        return hands

    def _hand_of(self, patch: Mask) -> Mask:
        edge = patch.copy()
        edge[1:-1, 1:-1] = False
        if self.length is None or not edge.any():
            return patch
        entry = np.argwhere(edge).mean(axis=0)
        rows, columns = np.indices(patch.shape)
        inwards = np.where(patch, np.hypot(rows - entry[0], columns - entry[1]), 0.0)
        return np.asarray(patch & (inwards >= inwards.max() - self.length))


@dataclass
class MovementDetector:
    """Finds what changed of late; what has just come to rest stays where it is.

    Args:
        threshold: A pixel moves when a colour of it changes by more than this [0..255].
        apart: Within so long: of a slow movement, one frame shows little to the next [s].
        blur: Pictures are smoothed by this before, so that their noise does not move [px].
        min_pixels: Fewer moving pixels than this are no hand.
        keep: A hand that rests is seen where it moved last for so long [s].
        margin: Unless that was nearer than this to an edge of the picture: it has left [px].
    """

    threshold: int
    apart: float
    blur: float
    min_pixels: int
    keep: float
    margin: float
    _before: Observation | None = field(default=None, init=False)
    _smooth: deque[tuple[int, Image]] = field(default_factory=deque, init=False)  # time [ns], frame
    _moved: Array = field(default_factory=lambda: np.empty((0, 2)), init=False)  # last [px]
    _moved_ns: int = field(default=0, init=False)

    def hand_in(self, seen: Observation) -> Array:
        """Centres of the hand's pixels, (n, 2) [px]; call with every observation, in order."""
        before, self._before = self._before, seen
        if before is None or seen.begins or (seen.frame_gaze != before.frame_gaze).any():
            self._smooth.clear()  # all would have moved
            self._moved = np.empty((0, 2))
        if not self._smooth or before is None or seen.frame_time_ns != before.frame_time_ns:
            self._compare(seen)
        resting_ns = seen.frame_time_ns - self._moved_ns
        if resting_ns > self.keep * SECOND or (resting_ns and self._has_left(seen.frame)):
            return np.empty((0, 2))
        return self._moved

    def _compare(self, seen: Observation) -> None:
        smooth = np.asarray(cv2.GaussianBlur(seen.frame, (0, 0), self.blur), dtype=np.uint8)
        earlier, now = self._smooth, seen.frame_time_ns
        earlier.append((now, smooth))
        while len(earlier) > 2 and now - earlier[1][0] >= self.apart * SECOND:
            earlier.popleft()
        moving = cv2.absdiff(smooth, earlier[0][1]).max(axis=2) > self.threshold
        places = _centres(moving, self.min_pixels)
        if len(places):
            self._moved, self._moved_ns = places, now

    def _has_left(self, frame: Image) -> bool:
        """Whether the last movement was at an edge of the picture."""
        if not len(self._moved):
            return True
        middle, size = self._moved.mean(axis=0), np.array(frame.shape[1::-1])
        return bool(np.minimum(middle, size - middle).min() < self.margin)


def _centres(mask: Mask, min_pixels: int) -> Array:
    """Centres of the pixels in a mask, (n, 2) [px]; none when there are fewer than asked."""
    found = cv2.findNonZero(mask.view(np.uint8))
    if found is None or len(found) < min_pixels:
        return np.empty((0, 2))
    return found.reshape(-1, 2).astype(np.float64) + 0.5
