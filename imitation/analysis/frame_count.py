"""How many frames a run decided on, decided on again, and passed over."""

from imitation.robot import Observation


class FrameCount:
    """Counts the frames of one step after the other."""

    def __init__(self) -> None:
        self._used = self._repeated = self._skipped = 0
        self._last_ns: int | None = None

    def add(self, seen: Observation) -> None:
        """Take notice of the frames of one more step."""
        again = seen.frame_time_ns == self._last_ns
        self._last_ns = seen.frame_time_ns
        self._used += not again
        self._repeated += again
        self._skipped += len(seen.skipped)

    def result(self) -> dict[str, int]:
        """What metrics.json tells of them."""
        return {
            "frames_used": self._used,
            "frames_repeated": self._repeated,
            "frames_skipped": self._skipped,
        }
