"""Notices hands that arrive: what stays in view is soon no news any more (habituation)."""

from collections import deque
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array, Mask
from imitation.visual_field import Area
from imitation.visual_states import Resting, middle_of_rest


@dataclass(frozen=True)
class Noticing:
    """What counts as a hand in an area; its YAML says what each means."""

    appearing: float
    leaving: float
    absence: float
    one_hand: float


class Arrivals:
    """Tells in which areas a hand has newly come to rest.

    Of areas that show the same hand, one has it. What was told of once is news again only after it
    was gone; so is what was there from the start, where the arm's own hand may be. Whose hand it
    is makes no difference.

    Args:
        resting: A hand has come to stay when it rests as in a visual state.
        noticing: What counts as a hand in an area.
        own: Areas that the own hand may be in from the start, (rows, columns).
    """

    def __init__(self, resting: Resting, noticing: Noticing, own: Mask) -> None:
        self.resting, self.noticing = resting, noticing
        self._own = own
        self._since = np.full(own.shape, np.nan)  # when each area's hand came [s]
        self._last = np.full(own.shape, -np.inf)  # when it was seen last [s]
        self._familiar = np.zeros_like(own)
        self._rested = np.full((*own.shape, 2), np.nan)  # where familiar hands rest [px]
        self._seen: deque[tuple[float, Array]] = deque()  # time [s] and hands [px], for `dwell`

    def notice(self, time: float, visual_input: Array, places: Array) -> dict[Area, float]:
        """Areas in which a hand has come to stay, and since when it is there [s].

        Args:
            time: Of the frame [s].
            visual_input: I, (rows, columns).
            places: Where what is seen in each area lies, (rows, columns, 2) [px]; nan: nothing is.
        """
        first = not self._seen
        wins, hands = self._hands(visual_input, places)
        self._seen.append((time, hands))
        while time - self._seen[0][0] > self.resting.dwell:
            self._seen.popleft()
        here = wins & (visual_input >= self.noticing.leaving)
        self._last[here] = time
        gone = time - self._last > self.noticing.absence
        self._since[gone], self._familiar[gone] = np.nan, False
        came = here & (visual_input >= self.noticing.appearing) & ~self.present
        self._since[came] = time
        self._take_for_granted(here & (self._own if first else self._known(hands)))
        return self._newly_resting(time, here & ~self._familiar)

    def grow_familiar(self) -> None:
        """Take all hands that are in view now for granted."""
        self._take_for_granted(self.present)

    @property
    def present(self) -> Mask:
        """Areas with a hand in them, (rows, columns)."""
        return np.asarray(~np.isnan(self._since))

    def _hands(self, visual_input: Array, places: Array) -> tuple[Mask, Array]:
        """Which areas show most of a hand, and where the hand of each lies, (..., 2) [px]."""
        flat, activity = np.nan_to_num(places).reshape(-1, 2), visual_input.ravel()
        apart = np.linalg.norm(flat[:, None] - flat, axis=-1)
        same = (apart < self.noticing.one_hand) & (activity > 0)
        keeps = (1 + self.resting.hysteresis) / (1 - self.resting.hysteresis)
        strength = activity * np.where(self.present.ravel(), keeps, 1.0)
        strength -= 1e-9 * np.arange(len(strength))  # of equal ones the first wins
        wins = (strength >= np.where(same, strength, -np.inf).max(axis=1)) & (activity > 0)
        shown = same @ activity
        hands = same @ (activity[:, None] * flat) / np.where(shown > 0, shown, np.nan)[:, None]
        return wins.reshape(visual_input.shape), hands.reshape(places.shape)

    def _known(self, hands: Array) -> Mask:
        """Areas whose hand rests where one is familiar: it is the same, seen across a border."""
        apart = np.linalg.norm(hands[..., None, :] - self._rested[self._familiar], axis=-1)
        return np.asarray((apart <= self.resting.still).any(axis=-1))

    def _take_for_granted(self, areas: Mask) -> None:
        _, hands = self._seen[-1]
        self._rested[areas & ~self._familiar] = hands[areas & ~self._familiar]
        self._familiar |= areas

    def _newly_resting(self, time: float, candidates: Mask) -> dict[Area, float]:
        resting = np.zeros_like(candidates)
        for row, column in np.argwhere(candidates & (time - self._since >= self.resting.dwell)):
            hands = np.array([hands[row, column] for _, hands in self._seen])
            seen = hands[~np.isnan(hands[:, 0])]
            resting[row, column] = middle_of_rest(seen, self.resting.still) is not None
        self._take_for_granted(resting)
        return {(int(r), int(c)): float(self._since[r, c]) for r, c in np.argwhere(resting)}
