"""The 16 sensors in the Katana's gripper (facts/katana.md, 2.7), read and emulated."""

from collections.abc import Sequence
from dataclasses import dataclass

CONDUCTIVITY = 3  # both fingers touch something that conducts
CENTRE = 11  # infrared, looks out of the palm
RIGHT_FORCE, LEFT_FORCE = (6, 7), (14, 15)
INFRARED = (0, 1, 4, 5, 8, 9, 11, 12, 13)
NOTHING_THERE = (20, 34, 0, 0, 51, 47, 3, 5, 21, 33, 0, 90, 52, 48, 4, 6)
CLOSE, REACH = 220, 0.05  # infrared when a thing touches the palm, and how far that looks [m]
PRESSED = 120  # force
JITTER = 1  # of infrared: a real one is never still


@dataclass(frozen=True)
class GripperSensing:
    """What the raw sensors mean.

    Args:
        empty: Infrared from the palm up to this: nothing is there [0..255].
        close: Infrared when a thing touches the palm [0..255].
        reach: How far the palm sees [m].
        pressed: Force from which on a finger touches something [0..255].
    """

    empty: int
    close: int
    reach: float
    pressed: int

    def proximity(self, sensors: Sequence[int]) -> float:
        """Distance from palm to what is there [m]; inf: nothing."""
        nearness = (sensors[CENTRE] - self.empty) / (self.close - self.empty)
        return float("inf") if nearness <= 0 else self.reach * max(1.0 - nearness, 0.0)

    def touching(self, sensors: Sequence[int]) -> bool:
        """Whether both fingers touch something."""
        return all(
            max(sensors[place] for place in side) >= self.pressed
            for side in (RIGHT_FORCE, LEFT_FORCE)
        )


@dataclass
class EmulatedSensors:
    """The sensors of an emulated gripper."""

    thing: int | None = None  # encoder at which the fingers touch what is between them
    distance: float = float("inf")  # from the palm to what is between the fingers [m]
    pressed: bool = False  # both fingers touch it
    frozen: bool = False
    _told: tuple[int, ...] = NOTHING_THERE

    def read(self, gripper: int, time: float) -> tuple[int, ...]:
        """All 16, when the gripper is at this encoder."""
        if self.frozen:
            return self._told
        told = list(NOTHING_THERE)
        for place in INFRARED:
            told[place] += round(time * 10) % (JITTER + 1)
        near = 0.0 if self.thing is not None else self.distance
        if near < REACH:
            told[CENTRE] = round(CLOSE - near / REACH * (CLOSE - NOTHING_THERE[CENTRE]))
        if self.pressed or (self.thing is not None and gripper <= self.thing):
            for place in (*RIGHT_FORCE, *LEFT_FORCE):
                told[place] = PRESSED
        self._told = tuple(told)
        return self._told
