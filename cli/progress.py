"""Shows on stderr how work goes on: a bar on a terminal, a plain line now and then otherwise."""

import sys
import time
from contextlib import AbstractContextManager

from rich.console import Console
from rich.progress import Progress, SpinnerColumn, TextColumn
from rich.text import Text

from imitation.sample import Sample

REFRESH = 0.1  # of the bar [s]
PAUSE = 5.0  # between plain lines [s]


def at_work(what: str) -> AbstractContextManager[object]:
    """Tells on a terminal what goes on, as long as it does."""
    return Console(stderr=True).status(Text(what), refresh_per_second=1 / REFRESH)


class ProgressReport:
    """Tells the robot time that has passed and what happened last.

    Args:
        name: Of the run.
    """

    def __init__(self, name: str) -> None:
        self._name, self._last_event = name, ""
        self._bar: Progress | None = None
        self._pause = PAUSE
        if sys.stderr.isatty():
            columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False))
            self._bar = Progress(*columns, console=Console(stderr=True), transient=True)
            self._task = self._bar.add_task(name, total=None)
            self._pause = REFRESH
        self._due = time.monotonic() + self._pause

    def __enter__(self) -> "ProgressReport":
        if self._bar:
            self._bar.start()
        return self

    def __exit__(self, *error: object) -> None:
        if self._bar:
            self._bar.stop()

    def step(self, sample: Sample) -> None:
        """Take notice of one more step."""
        if sample.events:
            self._last_event = f" · {sample.events[-1].sentence}"
        now = time.monotonic()
        if now < self._due:
            return
        self._due = now + self._pause
        line = f"{self._name} · {sample.seen.time:.1f} s of robot time{self._last_event}"
        if self._bar:
            self._bar.update(self._task, description=line)
        else:
            print(line, file=sys.stderr, flush=True)
