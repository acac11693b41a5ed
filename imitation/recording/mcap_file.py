"""A ROS 2 bag in an MCAP file: how it is written and read. The one module that knows MCAP."""

import json
import os
import struct
import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO

from mcap.data_stream import ReadDataStream, RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    Channel,
    Chunk,
    McapRecord,
    MessageIndex,
    Metadata,
    Schema,
)
from mcap.stream_reader import get_chunk_data_stream
from mcap.writer import MCAP0_MAGIC, CompressionType, Writer
from zstandard import ZstdError

from imitation.recording import messages
from imitation.recording.digest import Digest
from imitation.recording.step_messages import Message, Topic, topics
from imitation.robot import SECOND, Body
from imitation.sample import Sample
from imitation.visual_field import VisualField

WALL_LIMIT = 1.0  # a chunk older than this is closed, unless reproducible [s]
MESSAGE_HEAD = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, two times
RECORD_HEAD = struct.Struct("<BQ")  # opcode, length
NO_LIMIT = 1 << 62  # chunks are closed at the end of a step, never by their size
BESIDE_MESSAGES: dict[int, Any] = {
    Opcode.METADATA: Metadata,
    Opcode.ATTACHMENT: Attachment,
    Opcode.SCHEMA: Schema,
    Opcode.CHANNEL: Channel,
}
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
        self._writer: Any = _QuickWriter(self._stream, NO_LIMIT, CompressionType.ZSTD)
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


class _QuickWriter(Writer):
    """MCAP's writer with a message packed in one piece: the same bytes in a fifth of the time."""

    def __init__(self, *given: Any) -> None:
        super().__init__(*given)
        self._Writer__chunk_indices = _PackedIndex()
        self._Writer__metadata_indexes = _PackedIndex()

    def add_message(
        self, channel_id: int, log_time: int, data: bytes, publish_time: int, sequence: int = 0
    ) -> None:
        """Add a message to the open chunk."""
        chunk, told = self._Writer__chunk_builder, self._Writer__statistics  # type: ignore[attr-defined]
        index = chunk.message_indices.get(channel_id)
        if index is None:
            index = chunk.message_indices[channel_id] = _QuickIndex(channel_id, [])
        index.records.append((log_time, chunk.count))
        head = MESSAGE_HEAD.pack(
            Opcode.MESSAGE, 22 + len(data), channel_id, sequence, log_time, publish_time
        )
        chunk.record_writer.write(head)
        chunk.record_writer.write(data)
        first = chunk.num_messages == 0
        chunk.message_start_time = log_time if first else min(chunk.message_start_time, log_time)
        chunk.message_end_time = max(chunk.message_end_time, log_time)
        chunk.num_messages += 1
        first = told.message_count == 0
        told.message_start_time = log_time if first else min(told.message_start_time, log_time)
        told.message_end_time = max(told.message_end_time, log_time)
        told.message_count += 1
        told.channel_message_counts[channel_id] += 1


class _PackedIndex:
    """Stands for a list of index records; as objects, those of an hour would take 12 MB."""

    def __init__(self) -> None:
        self._records = RecordBuilder()

    def append(self, record: Any) -> None:
        """Add a record."""
        record.write(self._records)

    def __iter__(self) -> Iterator["_PackedIndex"]:
        yield self

    def write(self, stream: RecordBuilder) -> None:
        """Write all records."""
        stream.write(self._records.end())  # type: ignore[no-untyped-call]


class _QuickIndex(MessageIndex):
    """Where a channel's messages are in a chunk, packed in one piece."""

    def write(self, stream: RecordBuilder) -> None:
        """Write the index."""
        numbers = [number for record in self.records for number in record]
        content = struct.pack(f"<HI{len(numbers)}Q", self.channel_id, 8 * len(numbers), *numbers)
        stream.start_record(Opcode.MESSAGE_INDEX)
        stream.write(content)
        stream.finish_record()  # type: ignore[no-untyped-call]


def _geometry(field: VisualField) -> dict[str, str]:
    """What a reader needs to draw the areas."""
    x_edges, y_edges = field.edges
    return {
        "name": field.name,
        "x_edges_px": json.dumps(x_edges.tolist()),
        "y_edges_px": json.dumps(y_edges.tolist()),
    }


@dataclass
class Contents:
    """What a file holds beside its messages."""

    whole: bool = False  # closed as it should be, not cut
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)

    def take(self, record: McapRecord) -> None:
        """Keep what `record` says."""
        if isinstance(record, Metadata):
            self.metadata[record.name] = record.metadata
        elif isinstance(record, Attachment):
            self.attachments[record.name] = record.data
        elif isinstance(record, Channel):
            self.channels[record.id] = record
        elif isinstance(record, Schema):
            self.schemas[record.id] = record


def contents(path: Path) -> Contents:
    """What the file holds, as far as it goes.

    Raises:
        ValueError: It is no ROS 2 bag in an MCAP file, or it is damaged.
    """
    found = Contents()
    for record in _records(path, BESIDE_MESSAGES):
        found.take(record)
    with path.open("rb") as stream:
        stream.seek(-len(MCAP0_MAGIC), os.SEEK_END)
        found.whole = stream.read() == MCAP0_MAGIC
    if not found.whole:  # without the summary at its end, the channels stand in the chunks alone
        for _ in chunks(path, found):
            pass
    return found


def chunks(path: Path, found: Contents) -> Iterator[list[Message]]:
    """The messages of each chunk in the order written, up to where the file was cut.

    Args:
        path: The file.
        found: Learns the channels on the way.

    Raises:
        ValueError: A chunk is damaged.
    """
    for chunk in _records(path, {Opcode.CHUNK: Chunk}):
        try:
            stream, length = get_chunk_data_stream(chunk, validate_crc=True)
        except (ValueError, ZstdError) as error:
            at = chunk.message_start_time / SECOND
            raise ValueError(f"{path} is damaged at {at:.2f} s of the run: {error}") from error
        yield list(_messages(stream.read(length), found))


def _messages(data: bytes, found: Contents) -> Iterator[Message]:
    at = 0
    while at < len(data):
        opcode, length = RECORD_HEAD.unpack_from(data, at)
        start, end = at + RECORD_HEAD.size, at + RECORD_HEAD.size + length
        if opcode == Opcode.MESSAGE:
            _, _, channel, _, time_ns, _ = MESSAGE_HEAD.unpack_from(data, at)
            topic = found.channels[channel].topic
            yield Message(topic, time_ns, data[at + MESSAGE_HEAD.size : end])
        elif opcode in (Opcode.CHANNEL, Opcode.SCHEMA):
            found.take(BESIDE_MESSAGES[opcode].read(ReadDataStream(BytesIO(data[start:end]))))
        at = end


def _records(path: Path, kinds: Mapping[int, Any]) -> Iterator[Any]:
    """Whole records of some kinds, up to the file's end or to where it was cut."""
    size = path.stat().st_size
    with path.open("rb") as stream:
        _check_header(path, stream)
        while len(head := stream.read(RECORD_HEAD.size)) == RECORD_HEAD.size:
            opcode, length = RECORD_HEAD.unpack(head)
            end = stream.tell() + length
            if end > size:
                return
            if opcode in kinds:
                yield kinds[opcode].read(ReadDataStream(stream))
            stream.seek(end)


def _check_header(path: Path, stream: BinaryIO) -> None:
    if stream.read(len(MCAP0_MAGIC)) != MCAP0_MAGIC:
        raise ValueError(f"{path} is no recording: it is not an MCAP file")
    head = stream.read(RECORD_HEAD.size + 64)
    if b"ros2" not in head:
        raise ValueError(f"{path} is no recording of this bench: it is not a ROS 2 bag")
    stream.seek(len(MCAP0_MAGIC))
