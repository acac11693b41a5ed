"""A worker thread behind a bounded queue: first in, first out, nothing dropped."""

import queue
import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Item = TypeVar("Item")


class WorkFailedError(RuntimeError):
    """The worker has ended; why is its cause."""


class Worker(Generic[Item]):
    """Does `work` on batches of items in a thread; an error of it comes out at the next `put`.

    Args:
        work: What is done with a batch of items.
        batch: Items that the thread is woken for: a thread that runs holds up the loop that
            feeds it, and seldom and long does so less than often and short.
        limit: Most items that wait, those that are worked on included; at least a batch.
        pause: Longest that the thread waits for a whole batch before it takes what there is
            [s]; None: for ever.
    """

    def __init__(
        self, work: Callable[[list[Item]], None], batch: int, limit: int, pause: float | None
    ) -> None:
        self._work, self._batch, self._limit, self._pause = work, batch, limit, pause
        self._items: list[Item] = []
        self._changed = threading.Condition()
        self._finishing = False
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
        with self._changed:
            if not self._changed.wait_for(lambda: len(self._items) < self._limit, patience):
                raise queue.Full
            self.check()
            self._items.append(item)
            if len(self._items) == self._batch:
                self._changed.notify()

    def finish(self) -> None:
        """Wait until every item is done and the thread has ended; harmless when repeated."""
        with self._changed:
            self._finishing = True
            self._changed.notify()
        self._thread.join()

    def check(self) -> None:
        """Raise an error if the worker has failed."""
        if self._error is not None:
            raise WorkFailedError from self._error

    def _run(self) -> None:
        try:
            while batch := self._next():
                self._work(batch)
                self._done(len(batch))
        except BaseException as error:  # whatever ends the thread ends the run
            self._error = error
            self._done(self._limit)  # so that nobody waits for it

    def _next(self) -> list[Item]:
        """Wait for the next batch; it is empty when no more will come."""
        with self._changed:
            while not self._changed.wait_for(self._enough, self._pause) and not self._items:
                pass
            return self._items[: self._batch]

    def _enough(self) -> bool:
        return self._finishing or len(self._items) >= self._batch

    def _done(self, number: int) -> None:
        with self._changed:
            del self._items[:number]
            self._changed.notify()
