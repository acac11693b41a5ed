"""A worker thread behind a bounded queue: first in, first out, nothing dropped."""

import queue
import threading
from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

Item = TypeVar("Item")


class WorkFailedError(RuntimeError):
    """The worker has ended; why is its cause."""


class Worker(Generic[Item]):
    """Does `work` on each item in a thread; an error of it comes out at the next `put`.

    The thread is woken when the queue is half full: to wake it costs the loop that feeds it more
    than to hand on an item.

    Args:
        work: What is done with an item.
        idle: What is done when no item came for `pause`.
        limit: Most items that wait, the one that is worked on included.
        pause: Longest that items wait for more of them, then `idle` if there is none [s]; None:
            for ever.
    """

    def __init__(
        self,
        work: Callable[[Item], None],
        idle: Callable[[], None],
        limit: int,
        pause: float | None,
    ) -> None:
        self._work, self._idle, self._limit, self._pause = work, idle, limit, pause
        self._enough = (limit + 1) // 2
        self._items: deque[Item] = deque()
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
            if len(self._items) == self._enough:
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
            while self._come():
                while self._items:
                    self._work(self._items[0])
                    self._done()
        except BaseException as error:  # whatever ends the thread ends the run
            self._error = error
            while self._items:  # emptied, so that nobody waits for it
                self._done()

    def _come(self) -> bool:
        """Wait until there is enough to do; False when no more will come."""
        with self._changed:
            self._changed.wait_for(
                lambda: self._finishing or len(self._items) >= self._enough, self._pause
            )
        if self._items:
            return True
        if not self._finishing:
            self._idle()
        return not self._finishing

    def _done(self) -> None:
        with self._changed:
            self._items.popleft()
            self._changed.notify()
