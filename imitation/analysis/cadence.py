"""How many control steps a second there really were."""

from imitation.robot import SECOND, Observation


class Cadence:
    """Counts the steps and the time from each to the next, but not between episodes."""

    def __init__(self) -> None:
        self._steps = self._lasting_ns = 0
        self._last_ns: int | None = None

    def add(self, seen: Observation) -> None:
        """One more step."""
        if self._last_ns is not None and not seen.begins:
            self._steps += 1
            self._lasting_ns += seen.time_ns - self._last_ns
        self._last_ns = seen.time_ns

    @property
    def rate(self) -> float | None:
        """Steps a second [Hz]; None before there are two."""
        return self._steps * SECOND / self._lasting_ns if self._lasting_ns else None
