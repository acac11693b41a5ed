"""What a film or a live camera showed of a hand, to be printed at a run's end."""

from imitation.robot import SECOND
from imitation.sample import Sample


class Sight:
    """Counts the steps of a run in which a hand was seen, and how far apart the frames were."""

    def __init__(self) -> None:
        self._steps = self._seen = self._parted = self._frames = 0
        self._apart_ns = 0  # at most
        self._last_ns: int | None = None
        self._pieces = 1  # as the recording's events tell

    def add(self, sample: Sample) -> None:
        """One more step; those of a simulated camera count for nothing."""
        seen = sample.seen
        if seen.jpeg is None:
            return
        for event in sample.events:
            self._pieces = int(str(event.facts.get("pieces", self._pieces)))
        self._steps += 1
        self._seen += sample.percept.hand is not None
        self._parted += self._pieces == 2
        if seen.begins:
            self._last_ns = None
        for time_ns in (*(shot.time_ns for shot in seen.skipped), seen.frame_time_ns):
            if self._last_ns is not None:
                self._apart_ns = max(self._apart_ns, time_ns - self._last_ns)
            self._frames += time_ns != self._last_ns
            self._last_ns = time_ns

    @property
    def rows(self) -> list[tuple[str, str]]:
        """What is printed of it: name, value."""
        if not self._steps:
            return []
        parted = f", in two pieces in {self._parted / self._steps:.0%}" if self._parted else ""
        return [
            ("frames", f"{self._frames}, {self._apart_ns / SECOND:.2f} s apart at most"),
            ("hand", f"seen in {self._seen / self._steps:.0%} of the steps{parted}"),
        ]
