"""The recording: `run.mcap`, a ROS 2 bag written live. The one module that knows MCAP."""

import json
import queue
import time
from collections.abc import Iterable, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from types import TracebackType
from typing import Any, BinaryIO

from mcap.writer import CompressionType, Writer

from imitation.recording import messages
from imitation.recording.digest import Digest
from imitation.recording.fifo import Worker
from imitation.recording.step_messages import Message, StepMessages, Topic, topics
from imitation.robot import SECOND, Body, Truth
from imitation.sample import Sample
from imitation.visual_field import VisualField

LONGEST_QUEUE_NS = SECOND // 4
WALL_LIMIT = 1.0  # a chunk older than this is closed, unless reproducible [s]
NO_LIMIT = 1 << 62  # chunks are closed at the end of a step, never by their size
MEDIA_TYPES = {".yaml": "application/yaml", ".json": "application/json", ".urdf": "application/xml"}


class RecorderError(RuntimeError):
    """The recording cannot be written; said in one line."""


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
        waiting, chunk_ns = bounds(max_loss, period_ns)
        waiting, chunk_ns = bounds(max_loss, period_ns)
        self._name, self._patience = path.name, patience
        self._closed = self._failed = False
        self._steps = StepMessages(body)
        try:
            self._file = _McapFile(path, body, field, period_ns, chunk_ns, not reproducible)
            self._file.begin(metadata, attachments)
        except OSError as error:
            raise self._failure(error) from error
        self._worker: Worker[tuple[Sample, Sequence[Truth]]] = Worker(
            self._write, self._file.close_old_chunk, waiting, None if reproducible else 0.1
        )

    def write(self, sample: Sample, truths: Sequence[Truth]) -> None:
        """Record one step and what was true since the last one; their arrays must not change.

        Raises:
            RecorderError: Writing failed, now or before, or the queue stayed full for longer
                than `patience`: put the robot to rest and end the run.
        """
        try:
            self._worker.put((sample, truths), self._patience)
        except queue.Full as full:
            raise RecorderError(
                f"{self._name} cannot keep up: nothing could be written for {self._patience} s; "
                "record to a faster disk"
            ) from full
        except OSError as error:
            raise self._failure(error) from error

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
        except OSError as error:
            raise self._failure(error) from error
        finally:
            self._file.close()

    def __enter__(self) -> "Recorder":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _write(self, step: tuple[Sample, Sequence[Truth]]) -> None:
        sample, truths = step
        self._file.add_step(sample, self._steps.of(sample, truths))

    def _failure(self, error: OSError) -> RecorderError:
        self._failed = True
        return RecorderError(f"{self._name} cannot be written: {error.strerror or error}")


def bounds(max_loss: float, period_ns: int) -> tuple[int, int]:
    """How many steps may wait, and how long a chunk may be [ns], to lose `max_loss` [s] at most.

    Raises:
        ValueError: `max_loss` holds less than two periods.
    """
    loss_ns = round(max_loss * SECOND)
    if loss_ns < 2 * period_ns:
        raise ValueError(
            f"recording.max_loss={max_loss:g} s holds less than two control periods of "
            f"{period_ns / SECOND:g} s; give at least {2 * period_ns / SECOND:g}"
        )
    waiting = max(1, min(LONGEST_QUEUE_NS, loss_ns // 4) // period_ns)
    return waiting, loss_ns - waiting * period_ns


class _McapFile:
    """The file itself: records at its head, then chunks of whole steps, each with a digest.

    Args:
        path: The file; must not exist.
        body: The arm.
        field: The visual field.
        period_ns: Control period [ns].
        chunk_ns: Longest chunk in robot time [ns].
        by_clock: Whether a chunk is also closed after a second of wall time.
    """

    def __init__(
        self,
        path: Path,
        body: Body,
        field: VisualField,
        period_ns: int,
        chunk_ns: int,
        by_clock: bool,
    ) -> None:
        self._body, self._field, self._by_clock = body, field, by_clock
        self._period_ns, self._chunk_ns = period_ns, chunk_ns
        self._stream: BinaryIO = path.open("xb")
        self._writer: Any = Writer(self._stream, NO_LIMIT, CompressionType.ZSTD)
        self._known: dict[str, Topic] = {}
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}
        self._digest, self._digests = Digest(), 0
        self._chunk_start_ns: int | None = None  # robot time of the open chunk's first step
        self._chunk_start_wall = 0.0  # [s]

    def begin(self, metadata: Mapping[str, str], attachments: Mapping[str, bytes]) -> None:
        """Write what belongs to the run as a whole; it survives every kill."""
        self._writer.start(profile="ros2")
        self._writer.add_metadata("run", dict(metadata))
        if self._by_clock:
            now = datetime.now(UTC).isoformat(timespec="milliseconds")
            self._writer.add_metadata("clock", {"started": now})
        for name, data in attachments.items():
            kind = MEDIA_TYPES.get(Path(name).suffix, "application/octet-stream")
            self._writer.add_attachment(0, 0, name, kind, data)
        self._stream.flush()

    def add_step(self, sample: Sample, step: Iterable[Message]) -> None:
        """Write one step; closes the chunk when one more would make it too long."""
        now = sample.seen.time_ns
        if not self._known:
            self._known = topics(self._body, self._field, sample.seen.jpeg is not None)
        if self._chunk_start_ns is None:
            self._chunk_start_ns, self._chunk_start_wall = now, time.monotonic()
        for message in step:
            channel = self._channels.get(message.topic) or self._open_channel(message.topic)
            at = message.time_ns
            self._writer.add_message(channel, at, message.data, at)
            self._digest.add(message.topic, at, message.data)
        if now + 2 * self._period_ns - self._chunk_start_ns > self._chunk_ns:
            self._close_chunk()
        else:
            self.close_old_chunk()

    def close_old_chunk(self) -> None:
        """Close the chunk when it has been open for a second of wall time."""
        if not self._by_clock or self._chunk_start_ns is None:
            return
        if time.monotonic() - self._chunk_start_wall >= WALL_LIMIT:
            self._close_chunk()

    def seal(self) -> None:
        """Close the last chunk and write the file's summary."""
        if self._chunk_start_ns is not None or not self._digests:
            self._close_chunk()
        self._writer.finish()

    def close(self) -> None:
        """Close the file; harmless when repeated."""
        self._stream.close()

    def _close_chunk(self) -> None:
        self._chunk_start_ns = None
        self._digests += 1
        self._writer.flush()
        self._writer.add_metadata(f"digest/{self._digests:04d}", self._digest.values())
        self._stream.flush()

    def _open_channel(self, name: str) -> int:
        topic = self._known[name]
        if topic.type not in self._schemas:
            text = messages.definition(topic.type).encode()
            self._schemas[topic.type] = self._writer.register_schema(topic.type, "ros2msg", text)
        names = {"names": json.dumps(topic.names)} if topic.names else {}
        schema = self._schemas[topic.type]
        self._channels[name] = self._writer.register_channel(name, "cdr", schema, names)
        return self._channels[name]
