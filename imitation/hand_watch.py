"""Tells when what looks like a hand is gone, is back, or lies in two pieces; whose it is, never."""

from dataclasses import dataclass, field, replace

import numpy as np

from imitation.arrays import Array
from imitation.sample import Event, Sample

WHOLE, GONE, PARTED = "whole", "gone", "parted"
FAR = 1000.0  # beyond that, places are as good as equal [px]


@dataclass
class HandWatch:
    """Adds to the steps of a run what has become of the hand in view. It decides nothing.

    Args:
        after: A change is told once it has lasted for so long [s].
        gap: What is farther apart than this, with nothing between, is two pieces [px].
        least: A piece smaller than this share of all is a speck [0..1].
    """

    after: float
    gap: float
    least: float
    _told: str = field(default=WHOLE, init=False)
    _state: str = field(default=WHOLE, init=False)
    _since: float = field(default=0.0, init=False)  # [s]

    def noticed(self, sample: Sample) -> Sample:
        """The step with the event of a change; call with every step, in order."""
        pixels, now = sample.percept.pixels, sample.seen.time
        apart = self.apart(pixels)
        state = GONE if not len(pixels) else WHOLE if apart is None else PARTED
        if state != self._state:
            self._state, self._since = state, now
        if state == self._told or now - self._since < self.after:
            return sample
        event, self._told = self._event(apart), state
        return replace(sample, events=(*sample.events, event))

    def apart(self, pixels: Array) -> float | None:
        """Between the centres of the two pieces of `pixels` (n, 2) [px]; None: it is one."""
        if not len(pixels):
            return None
        for along in pixels.T:
            cells = np.minimum(along - along.min(), FAR).astype(np.intp)
            counts = np.bincount(cells)
            filled = np.flatnonzero(counts)
            gaps = np.diff(filled)
            if gaps.max(initial=0) <= self.gap:
                continue
            end = filled[gaps.argmax()]
            share = counts[: end + 1].sum() / len(cells)
            if min(share, 1 - share) >= self.least:
                one = cells <= end
                between = pixels[one].mean(axis=0) - pixels[~one].mean(axis=0)
                return float(np.hypot(*between))
        return None

    def _event(self, apart: float | None) -> Event:
        if self._state == GONE:
            return Event("hand", "no hand is seen any more", {"pieces": 0})
        if apart is not None:
            told = f"what looks like a hand lies in two pieces, {apart:.0f} px apart"
            return Event("hand", told, {"pieces": 2, "apart_px": round(apart, 1)})
        gone = self._told == GONE
        told = "a hand is seen again" if gone else "what looks like a hand is one piece again"
        return Event("hand", told, {"pieces": 1})
