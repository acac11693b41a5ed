"""Ctrl-C and SIGTERM end a run between two steps, never in the middle of one."""

import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Any

SIGNALS = (signal.SIGINT, signal.SIGTERM)
STOP = ".stop"  # a file of this name in a sweep's folder ends its jobs, on whatever machine
LOOK = 0.25  # between two looks for it [s]


class Interruption:
    """While entered, the first signal is only noted; a second one interrupts at once.

    Args:
        sweep: Folder of the sweep whose job this is; None outside a sweep.
        at_once: Tells when the first signal interrupts too: there is no end of a step to wait for.
    """

    def __init__(self, sweep: Path | None, at_once: Callable[[], bool]) -> None:
        self._at_once = at_once
        self._stop = sweep / STOP if sweep else None
        self._noted, self._look = False, 0.0
        self._before: dict[signal.Signals, Any] = {}

    @property
    def wanted(self) -> bool:
        """Whether someone asked for the end."""
        if not self._noted and self._stop and time.monotonic() >= self._look:
            self._noted, self._look = self._stop.exists(), time.monotonic() + LOOK
        return self._noted

    def __enter__(self) -> "Interruption":
        self._before = {number: signal.signal(number, self._note) for number in SIGNALS}
        return self

    def __exit__(self, *error: object) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _note(self, number: int, frame: FrameType | None) -> None:
        if self._noted or self._at_once():
            raise KeyboardInterrupt
        self._noted = True


@contextmanager
def sigterm_like_ctrl_c() -> Iterator[None]:
    """SIGTERM does inside what Ctrl-C does."""

    def interrupt(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


@contextmanager
def waiting_for_the_jobs(sweep: Path) -> Iterator[None]:
    """The first signal inside tells a sweep's jobs to end, wherever they run, and waits for them.

    A launcher that is interrupted itself kills its processes before their recordings are closed.
    """

    def stop(number: int, frame: FrameType | None) -> None:
        if (sweep / STOP).exists():
            raise KeyboardInterrupt
        (sweep / STOP).touch()

    before = {number: signal.signal(number, stop) for number in SIGNALS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        (sweep / STOP).unlink(missing_ok=True)
