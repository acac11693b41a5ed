"""A worker thread behind a bounded queue: first in, first out, nothing dropped."""

import queue
import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Item = TypeVar("Item")


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
        # Two plain queues, of items and of free places, cost a fifth of one that is bounded.
        self._items: queue.SimpleQueue[Item | None] = queue.SimpleQueue()
        self._places: queue.SimpleQueue[None] = queue.SimpleQueue()
        for _ in range(limit):
            self._places.put(None)
        self._error: Exception | None = None
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)
        self._thread.start()

    def put(self, item: Item, patience: float | None) -> None:
        """Hand on an item, waiting while the queue is full.

        Args:
            item: What to work on; not to be changed afterwards.
            patience: Longest wait [s]; None: as long as it takes.

        Raises:
            queue.Full: The queue stayed full for longer than `patience`.
            Exception: Whatever the worker failed with.
        """
        self.check()
        try:
            self._places.get(timeout=patience)
        except queue.Empty:
            raise queue.Full from None
        self._items.put(item)

    def finish(self) -> None:
        """Wait until every item is done and the thread has ended; harmless when repeated."""
        if self._thread.is_alive():
            self._items.put(None)
            self._thread.join()

    def check(self) -> None:
        """Raise the worker's error, if it has one."""
        if self._error is not None:
            raise self._error

    def _run(self) -> None:
        try:
            while (item := self._next()) is not None:
                self._work(item)
        except Exception as error:
            self._error = error
            while self._items.get() is not None:  # emptied, so that nobody waits for it
                self._places.put(None)

    def _next(self) -> Item | None:
        while True:
            try:
                item = self._items.get(timeout=self._pause)
            except queue.Empty:
                self._idle()
                continue
            self._places.put(None)
            return item
