"""Pairs a frame with the posture the arm had when it was captured."""

from bisect import bisect_left
from collections import deque

from imitation.arrays import Array
from imitation.clock import SECOND


class PostureHistory:
    """The postures of the last `span` seconds, to be asked by time."""

    def __init__(self, span: float) -> None:
        self._span_ns = round(span * SECOND)
        self._times: deque[int] = deque()
        self._postures: deque[Array] = deque()

    def note(self, time_ns: int, posture: Array) -> None:
        """Remember `posture` (n_joints,) [rad], sensed at `time_ns`."""
        self._times.append(time_ns)
        self._postures.append(posture)
        while time_ns - self._times[0] > self._span_ns:
            self._times.popleft()
            self._postures.popleft()

    def at(self, time_ns: int) -> Array:
        """The posture sensed nearest to `time_ns`, (n_joints,) [rad]."""
        after = bisect_left(self._times, time_ns)
        if after == len(self._times):
            return self._postures[-1]
        if after and time_ns - self._times[after - 1] < self._times[after] - time_ns:
            return self._postures[after - 1]
        return self._postures[after]
