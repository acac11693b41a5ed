"""When control steps begin: at the ticks of a simulated clock, or of the wall clock."""

import time
from typing import Protocol

SECOND = 1_000_000_000  # [ns]


class Clock(Protocol):
    """Tells the run's time [ns]; its first episode begins at 0, and it never goes back."""

    late: int  # ticks that came too late

    def begin(self) -> int:
        """An episode begins: the time."""

    def tick(self) -> int:
        """Wait until a period after the last tick: the time then."""

    def now(self) -> int:
        """The time."""


class SimulatedClock:
    """Time passes as fast as it is computed.

    Args:
        period_ns: Control period [ns].
    """

    late = 0

    def __init__(self, period_ns: int) -> None:
        self._period_ns, self._time_ns = period_ns, -period_ns

    def begin(self) -> int:
        """An episode begins at the next tick."""
        return self.tick()

    def tick(self) -> int:
        """A period has passed."""
        self._time_ns += self._period_ns
        return self._time_ns

    def now(self) -> int:
        """The time, which stands still between two ticks."""
        return self._time_ns


class WallClock:
    """Ticks a period apart, each at a deadline of its own, so that delays do not add up.

    Args:
        period_ns: Control period [ns].
    """

    def __init__(self, period_ns: int) -> None:
        self._period_ns, self._start_ns, self._deadline_ns = period_ns, 0, 0
        self.late = 0

    def begin(self) -> int:
        """An episode begins now: ticks are counted from here."""
        if not self._start_ns:
            self._start_ns = time.monotonic_ns()
            return 0
        self._deadline_ns = time.monotonic_ns() - self._start_ns
        return self._deadline_ns

    def tick(self) -> int:
        """Wait for the next deadline; those that passed meanwhile are left out."""
        self._deadline_ns += self._period_ns
        ahead = self._start_ns + self._deadline_ns - time.monotonic_ns()
        if ahead > 0:
            time.sleep(ahead / SECOND)
        else:
            self.late += 1
            self._deadline_ns += -ahead // self._period_ns * self._period_ns
        return self.now()

    def now(self) -> int:
        """The time since the first episode began."""
        return time.monotonic_ns() - self._start_ns
