"""From what is seen of a hand to visual states: where it rests, in which area, since when (IV)."""

from collections import deque
from dataclasses import dataclass, replace

import numpy as np

from imitation.arrays import Array
from imitation.visual_field import Area, VisualField, most_active


@dataclass(frozen=True)
class VisualState:
    """An area in which the hand rested."""

    area: Area
    place: Array  # median of where it was seen resting, (2,) [px of visual space]
    time: float  # when the area began to win [s]


@dataclass(frozen=True)
class Resting:
    """What counts as a visual state."""

    dwell: float  # one area wins, and the hand rests, for this long [s]
    still: float  # resting: seen this near to the middle of the places seen meanwhile [px]
    hysteresis: float  # an area wins from another by this much [share of what both show]
    lost: float  # a hand unseen for longer has left [s]


def middle_of_rest(places: Array, still: float) -> Array | None:
    """The middle of `places` (n, 2) [px]; None when one lies farther than `still` from it."""
    middle = np.median(places, axis=0)
    far = np.linalg.norm(places - middle, axis=1).max()
    return None if far > still else np.asarray(middle)


class VisualStates:
    """Watches a hand and tells the states it comes through, each as soon as it is one.

    An area that is only crossed is none, however often its border is; a hand that goes on resting,
    on whichever side of a border it is seen, makes no second one.
    """

    def __init__(self, resting: Resting, field: VisualField) -> None:
        self.resting, self.field = resting, field
        self.states: list[VisualState] = []
        self._seen: deque[tuple[float, Array]] = deque()  # time [s] and place [px], for `dwell`
        self._rested: list[Array] = []  # places of the newest state's rest, (2,) [px]
        self._area: Area | None = None  # the one that wins
        self._since = 0.0  # when it began to [s]
        self._missed = False  # the newest frame showed no hand

    def see(self, time: float, visual_input: Array, hand: Array | None) -> VisualState | None:
        """Take notice of a new frame; returns the state that the hand is found in, if it is new.

        Args:
            time: When the frame was captured [s].
            visual_input: I, (rows, columns).
            hand: Where the hand is seen, (2,) [px]; None: it is not.
        """
        if hand is None or not visual_input.any():
            self._missed = True
            return None
        if self._missed and self._seen and time - self._seen[-1][0] > self.resting.lost:
            self._seen.clear()
            self._area = None
        self._missed = False
        winner = self._winner(visual_input, hand)
        if winner != self._area:
            self._area, self._since = winner, time
        self._seen.append((time, hand))
        while time - self._seen[0][0] > self.resting.dwell:
            self._seen.popleft()
        return self._new_state(time)

    def _winner(self, visual_input: Array, hand: Array) -> Area:
        strongest = most_active(visual_input)
        if self._area is None:
            return strongest
        if np.linalg.norm(hand - self.field.into(hand, self._area)) > self.resting.still:
            return strongest  # what is seen is large, or another hand: its place is elsewhere
        first, second = visual_input[strongest], visual_input[self._area]
        wins = first - second > self.resting.hysteresis * (first + second)
        return strongest if wins else self._area

    def _new_state(self, time: float) -> VisualState | None:
        if self._area is None or time - self._since < self.resting.dwell:
            return None
        places = np.array([place for _, place in self._seen])
        middle = middle_of_rest(places, self.resting.still)
        if middle is None:
            return None
        if self.states:
            last = self.states[-1]
            if np.linalg.norm(middle - last.place) <= self.resting.still:
                self._rested.append(places[-1])
                self.states[-1] = replace(last, place=np.median(self._rested, axis=0))
                return None
            if self._area == last.area:
                return None
        self._rested = list(places)
        self.states.append(VisualState(self._area, middle, self._since))
        return self.states[-1]
