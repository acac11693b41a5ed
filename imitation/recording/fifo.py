"""A worker thread behind a bounded queue: first in, first out, nothing dropped."""

import queue
import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Item = TypeVar("Item")


class WorkFailedError(RuntimeError):
    """The worker has ended; why is its cause."""


class Worker(Generic[Item]):
    """Does `work` on each item in a thread; an error of it comes out at the next `put`.

    Args:
        work: What is done with an item.
        idle: What is done when no item came for `pause`.
        limit: Most items that wait.
        pause: How long to wait for an item before `idle` [s]; None: for ever.
    """

    def __init__(
        self,
        work: Callable[[Item], None],
        idle: Callable[[], None],
        limit: int,
        pause: float | None,
    ) -> None:
        self._work, self._idle, self._pause = work, idle, pause
        self._queue: queue.Queue[Item | None] = queue.Queue(limit)
        self._error: BaseException | None = None
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)
        self._thread.start()

    def put(self, item: Item, patience: float | None) -> None:
        """Hand on an item, waiting while the queue is full.

        Args:
            item: What to work on; not to be changed afterwards.
            patience: Longest wait [s]; None: as long as it takes.

        Raises:
            queue.Full: The queue stayed full for longer than `patience`.
            WorkFailedError: The thread has ended.
        """
        self.check()
        self._queue.put(item, timeout=patience)

    def finish(self) -> None:
        """Wait until every item is done and the thread has ended; harmless when repeated."""
        if self._thread.is_alive():
            self._queue.put(None)
            self._thread.join()

    def check(self) -> None:
        """Raise an error if the worker has failed."""
        if self._error is not None:
            raise WorkFailedError from self._error

    def _run(self) -> None:
        try:
            while (item := self._next()) is not None:
                self._work(item)
        except BaseException as error:  # whatever ends the thread ends the run
            self._error = error
            while self._queue.get() is not None:  # emptied, so that nobody waits for it
                pass

    def _next(self) -> Item | None:
        while True:
            try:
                return self._queue.get(timeout=self._pause)
            except queue.Empty:
                self._idle()
