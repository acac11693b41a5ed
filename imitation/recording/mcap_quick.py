"""MCAP's writer with many messages packed at once: the same bytes in a tenth of the time."""

import struct
import zlib
from collections.abc import Iterator, Sequence
from typing import Any, BinaryIO

from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import Chunk, ChunkIndex, MessageIndex
from mcap.writer import CompressionType, Writer
from zstandard import compress

from imitation.recording.step_messages import Message

NO_LIMIT = 1 << 62  # chunks are closed at the end of a step, never by their size
MESSAGE = int(Opcode.MESSAGE)
PACK = struct.Struct("<BQHIQQ").pack  # opcode, length, channel, sequence, two times


class QuickWriter(Writer):
    """The writer, of whole chunks.

    Args:
        stream: Where to.

    Attributes:
        stream: The same.
        channels: The channel of each topic.
    """

    def __init__(self, stream: BinaryIO) -> None:
        super().__init__(stream, NO_LIMIT, CompressionType.ZSTD)
        self.stream = stream
        self.channels: dict[str, int] = {}
        self._Writer__chunk_indices = _PackedIndex()
        self._Writer__metadata_indexes = _PackedIndex()

    def register_channel(self, topic: str, *given: Any) -> int:
        """Number of a new channel."""
        self.channels[topic] = super().register_channel(topic, *given)
        return self.channels[topic]

    def add_chunk(self, messages: Sequence[Message]) -> None:
        """Write messages as one chunk; the channels of their topics are registered."""
        chunk, told = self._Writer__chunk_builder, self._Writer__statistics  # type: ignore[attr-defined]
        parts, at = list[bytes](), chunk.count
        for topic, time_ns, data in messages:
            channel, length = self.channels[topic], 22 + len(data)
            index = chunk.message_indices.get(channel)
            if index is None:
                index = chunk.message_indices[channel] = _QuickIndex(channel, [])
            index.records.append((time_ns, at))
            parts += (PACK(MESSAGE, length, channel, 0, time_ns, time_ns), data)
            at += 9 + length
        chunk.record_writer._buffer.writelines(parts)
        times = [message.time_ns for message in messages]
        chunk.message_start_time, chunk.message_end_time = min(times), max(times)
        chunk.num_messages = len(messages)
        for channel, index in chunk.message_indices.items():
            told.channel_message_counts[channel] += len(index.records)
        started = min(told.message_start_time, min(times)) if told.message_count else min(times)
        told.message_start_time = started
        told.message_end_time = max(told.message_end_time, max(times))
        told.message_count += len(messages)
        self._close_chunk()
        self.flush()  # type: ignore[no-untyped-call]

    def packed(self, records: bytes) -> bytes:
        """The records of a chunk, compressed."""
        return compress(records)

    def _close_chunk(self) -> None:
        """Write the chunk, and where in it each channel's messages are."""
        chunk, records = self._Writer__chunk_builder, self._Writer__record_builder  # type: ignore[attr-defined]
        content = chunk.end()
        packed, start = self.packed(content), self.stream.tell()
        times = {
            "message_start_time": chunk.message_start_time,
            "message_end_time": chunk.message_end_time,
        }
        told = {"compression": "zstd", "uncompressed_size": len(content), **times}
        Chunk(data=packed, uncompressed_crc=zlib.crc32(content), **told).write(records)
        self.stream.write(records.end())
        indices_start, offsets = self.stream.tell(), dict[int, int]()
        for channel, index in chunk.message_indices.items():
            offsets[channel] = indices_start + records.count
            index.write(records)
        index = ChunkIndex(
            chunk_start_offset=start,
            chunk_length=indices_start - start,
            message_index_offsets=offsets,
            message_index_length=records.count,
            compressed_size=len(packed),
            **told,
        )
        self._Writer__chunk_indices.append(index)
        self._Writer__statistics.chunk_count += 1  # type: ignore[attr-defined]
        self.stream.write(records.end())
        chunk.reset()


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
