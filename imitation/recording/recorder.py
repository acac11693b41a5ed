"""The recording `run.mcap`, written live from a thread."""

import queue
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from imitation.recording.fifo import Worker, WorkFailedError
from imitation.recording.mcap_file import McapFile, new_file
from imitation.recording.mcap_quick import QuickWriter
from imitation.recording.step_messages import Message, StepMessages, event_message
from imitation.robot import SECOND, Body, Truth
from imitation.sample import Event, Sample
from imitation.visual_field import VisualField

LONGEST_QUEUE_NS = SECOND // 4  # of steps that come while a chunk is written
WALL_LIMIT = 1.0  # a step that waits for longer is written, unless reproducible [s]


class RecorderError(RuntimeError):
    """The recording cannot be written; said in one line."""


@dataclass(frozen=True)
class Happening:
    """What happened outside a step."""

    time_ns: int  # since the start of the run
    event: Event


Told = tuple[Sample, Sequence[Truth]] | Happening


class Recorder:
    """Writes each step of a run to a file, from a thread, and drops nothing.

    Args:
        path: The file; must not exist.
        body: The arm.
        field: The visual field.
        period_ns: Control period [ns].
        metadata: What the record `run` says: command, version, seed, ...
        attachments: Files that belong to the run, by name.
        max_loss: Most robot time that a kill may lose [s].
        reproducible: Whether the same run is to give the same bytes. If not, a record `clock`
            tells when it started, and slow runs are also saved once a second of wall time.
        patience: Longest that a write may wait for the disk [s of wall time]: a period of a
            robot in real time; None for a simulation, which can wait.

    Raises:
        RecorderError: The file cannot be made.
        ValueError: `max_loss` holds less than two periods.
    """

    def __init__(
        self,
        path: Path,
        body: Body,
        field: VisualField,
        period_ns: int,
        metadata: Mapping[str, str],
        attachments: Mapping[str, bytes],
        max_loss: float,
        reproducible: bool,
        patience: float | None = None,
    ) -> None:
        chunk, limit = bounds(max_loss, period_ns)
        self.path, self._patience = path, patience
        self._closed = self._failed = False
        self._steps = StepMessages(body)
        try:
            self._file = McapFile(QuickWriter(new_file(path)), body, field)
            self._file.begin(metadata, attachments, None if reproducible else _clock())
        except OSError as error:
            raise self._failure(error) from error
        self._worker: Worker[Told] = Worker(
            self._write, chunk, limit, None if reproducible else WALL_LIMIT
        )

    def write(self, sample: Sample, truths: Sequence[Truth]) -> None:
        """Record one step and what was true since the last one; their arrays must not change.

        Raises:
            RecorderError: Writing failed, now or before, or the queue stayed full for longer
                than `patience`: put the robot to rest and end the run.
        """
        self._put((sample, truths))

    def tell(self, happening: Happening) -> None:
        """Record what happened after the last step, or before the first.

        Raises:
            RecorderError: As `write` does.
        """
        self._put(happening)

    def _put(self, what: Told) -> None:
        try:
            self._worker.put(what, self._patience)
        except queue.Full as full:
            raise RecorderError(
                f"{self.path.name} cannot keep up: nothing written for {self._patience} s; "
                "record to a faster disk"
            ) from full
        except WorkFailedError as error:
            raise self._failure(error.__cause__ or error) from error

    def close(self) -> None:
        """Write what waits, seal the file and close it; harmless when repeated.

        Raises:
            RecorderError: Writing failed.
        """
        if self._closed:
            return
        self._closed = True
        self._worker.finish()
        try:
            if not self._failed:
                self._worker.check()
                self._file.seal()
        except WorkFailedError as error:
            raise self._failure(error.__cause__ or error) from error
        except OSError as error:
            raise self._failure(error) from error
        finally:
            with suppress(OSError):  # of bytes that were refused, and told of, before
                self._file.close()

    def __enter__(self) -> "Recorder":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def _write(self, told: Sequence[Told]) -> None:
        messages = [message for one in told for message in self._messages(one)]
        steps = (one[0] for one in told if isinstance(one, tuple))
        self._file.add_chunk(messages, jpeg=any(step.seen.jpeg is not None for step in steps))

    def _messages(self, told: Told) -> Iterable[Message]:
        if isinstance(told, Happening):
            return [event_message(told.time_ns, told.event)]
        return self._steps.of(*told)

    def _failure(self, error: BaseException) -> RecorderError:
        self._failed = True
        told = error.strerror if isinstance(error, OSError) else None
        return RecorderError(f"{self.path.name} cannot be written: {told or repr(error)}")


def _clock() -> dict[str, str]:
    return {"started": datetime.now(UTC).isoformat(timespec="milliseconds")}


def bounds(max_loss: float, period_ns: int) -> tuple[int, int]:
    """How many steps make a chunk, and how many may wait or be in it, to lose `max_loss` [s].

    Raises:
        ValueError: `max_loss` holds less than two periods.
    """
    limit = round(max_loss * SECOND) // period_ns
    if limit < 2:
        raise ValueError(
            f"recording.max_loss={max_loss:g} s holds less than two control periods of "
            f"{period_ns / SECOND:g} s; give at least {2 * period_ns / SECOND:g}"
        )
    waiting = max(1, min(LONGEST_QUEUE_NS // period_ns, limit // 4))
    return limit - waiting, limit
