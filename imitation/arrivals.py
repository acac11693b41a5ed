"""Notices hands that arrive: what stays in view is soon no news any more (habituation)."""

import numpy as np

from imitation.arrays import Array, Mask
from imitation.visual_field import Area


class Arrivals:
    """Tells in which areas a hand has newly come to stay.

    An area's activity must rise from nothing and then last. What was there from the start, or has
    been told of once, is news again only after it was gone. Whose hand it is makes no difference.

    Args:
        appearing: Visual input from which on a hand is in an area, share of what is seen [0..1].
        leaving: Visual input below which it is not, the smaller one [0..1].
        dwell: A hand has come to stay after this long [s].
        absence: An area is empty again after this long [s].
    """

    def __init__(self, appearing: float, leaving: float, dwell: float, absence: float) -> None:
        self.appearing, self.leaving, self.dwell, self.absence = appearing, leaving, dwell, absence
        self._since: Array | None = None  # since when a hand is in each area [s]; nan: it is not

    def notice(self, time: float, visual_input: Array) -> dict[Area, float]:
        """Areas in which a hand has come to stay, and since when it is there [s].

        Args:
            time: Of the frame [s].
            visual_input: I, (rows, columns).
        """
        if self._since is None:
            self._begin(time, visual_input)
        assert self._since is not None
        present = visual_input >= self.appearing
        self._last[visual_input >= self.leaving] = time
        gone = time - self._last > self.absence
        self._since[gone], self._familiar[gone] = np.nan, False
        self._since[present & np.isnan(self._since)] = time
        arrived = (self._last - self._since >= self.dwell) & ~self._familiar
        self._familiar |= arrived
        return {(int(r), int(c)): float(self._since[r, c]) for r, c in np.argwhere(arrived)}

    def grow_familiar(self) -> None:
        """Take all hands that are in view now for granted."""
        self._familiar |= self.present

    @property
    def present(self) -> Mask:
        """Areas with a hand in them, (rows, columns)."""
        assert self._since is not None
        return np.asarray(~np.isnan(self._since))

    def _begin(self, time: float, visual_input: Array) -> None:
        self._familiar = visual_input > 0
        self._since = np.where(self._familiar, time, np.nan)
        self._last = np.where(self._familiar, time, -np.inf)
