"""A ROS 2 bag in an MCAP file: how a run is written."""

import fcntl
import json
import time
from collections.abc import Iterable, Mapping
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, BinaryIO

from mcap.writer import CompressionType

from imitation.recording import messages
from imitation.recording.digest import Digest
from imitation.recording.mcap_quick import NO_LIMIT, QuickWriter
from imitation.recording.step_messages import Message, Topic, topics
from imitation.robot import Body
from imitation.sample import Sample
from imitation.visual_field import VisualField

WALL_LIMIT = 1.0  # a chunk older than this is closed, unless reproducible [s]
MEDIA_TYPES = {".yaml": "application/yaml", ".json": "application/json", ".urdf": "application/xml"}


class McapFile:
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
        with suppress(OSError):  # not every file system can tell that it is being written
            fcntl.flock(self._stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        self._writer: Any = QuickWriter(self._stream, NO_LIMIT, CompressionType.ZSTD)
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
        self._writer.add_metadata("field", _geometry(self._field))
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
        self._stream.flush()

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


def _geometry(field: VisualField) -> dict[str, str]:
    """What a reader needs to draw the areas."""
    x_edges, y_edges = field.edges
    return {
        "name": field.name,
        "x_edges_px": json.dumps(x_edges.tolist()),
        "y_edges_px": json.dumps(y_edges.tolist()),
    }
