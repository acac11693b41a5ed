"""What an MCAP file holds, whole or cut: records and messages in the order written."""

import struct
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Header, McapRecord, Metadata, Schema
from mcap.stream_reader import get_chunk_data_stream
from mcap.writer import MCAP0_MAGIC
from zstandard import ZstdError, frame_content_size

from imitation.recording.step_messages import Message
from imitation.robot import SECOND

LARGEST_CHUNK = 2**28  # no chunk of ours comes near [bytes]
MESSAGE_FIELDS = struct.Struct("<HIQQ")  # channel, sequence, two times; the data follows
END = struct.Struct("<BQQQI8s")  # the footer: opcode, length, two offsets, checksum; then the magic
CHECKSUM = struct.Struct("<I")  # at the end of an attachment; 0: none
RECORD_HEAD = struct.Struct("<BQ")  # opcode, length
BESIDE_MESSAGES: dict[int, Any] = {
    Opcode.HEADER: Header,
    Opcode.METADATA: Metadata,
    Opcode.ATTACHMENT: Attachment,
    Opcode.SCHEMA: Schema,
    Opcode.CHANNEL: Channel,
}


@dataclass
class Contents:
    """What a file holds beside its messages."""

    profile: str = ""  # ros2 for a bag of ours
    whole: bool = False  # closed as it should be, not cut
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    twice: str = ""  # a name that two different records have; empty: none

    def take(self, record: McapRecord) -> None:
        """Keep what `record` says."""
        if isinstance(record, Header):
            self.profile = record.profile
        elif isinstance(record, Metadata):
            if self.metadata.setdefault(record.name, record.metadata) != record.metadata:
                self.twice = record.name
        elif isinstance(record, Attachment):
            if self.attachments.setdefault(record.name, record.data) != record.data:
                self.twice = record.name
        elif isinstance(record, Channel):
            self.channels[record.id] = record
        elif isinstance(record, Schema):
            self.schemas[record.id] = record


def contents(path: Path) -> Contents:
    """What the file holds, as far as it goes.

    Raises:
        ValueError: It is no MCAP file, or it is damaged.
    """
    found = Contents()
    for record in records(path, BESIDE_MESSAGES):
        found.take(record)
    found.whole = is_whole(path)
    if found.whole:
        _check_summary(path)
    else:  # without the summary at its end, the channels stand in the chunks alone
        for _ in chunks(path, found):
            pass
    return found


def is_whole(path: Path) -> bool:
    """Whether an MCAP file was closed as it should be, not cut."""
    with path.open("rb") as stream:
        stream.seek(max(path.stat().st_size - len(MCAP0_MAGIC), len(MCAP0_MAGIC)))
        return stream.read() == MCAP0_MAGIC


def _check_summary(path: Path) -> None:
    """Raise an error when the summary at a file's end is not what its checksum says."""
    size = path.stat().st_size
    with path.open("rb") as stream:
        stream.seek(max(size - END.size, 0))
        opcode, length, start, _, told, _ = END.unpack(stream.read(END.size).rjust(END.size))
        stream.seek(min(start or size - END.size, size))  # 0: there is no summary
        summary = stream.read(size)[: -CHECKSUM.size - len(MCAP0_MAGIC)]
    if (opcode, length) != (Opcode.FOOTER, 20) or (told and told != zlib.crc32(summary)):
        raise ValueError(f"{path} is damaged: its summary is not what was written")


def chunks(path: Path, found: Contents) -> Iterator[list[Message]]:
    """The messages of each chunk in the order written, up to where the file was cut.

    Args:
        path: The file.
        found: Learns the channels on the way.

    Raises:
        ValueError: A chunk is damaged.
    """
    for chunk in records(path, {Opcode.CHUNK: Chunk}):
        yield [
            Message(channel.topic, time_ns, data)
            for channel, time_ns, data in told_in(path, chunk, found)
        ]


def told_in(path: Path, chunk: Chunk, found: Contents) -> list[tuple[Channel, int, bytes]]:
    """Channel, time [ns] and data of each message in a chunk.

    Raises:
        ValueError: It is damaged.
    """
    data = unpacked(path, chunk)
    try:
        return list(_messages(data, found))
    except (KeyError, McapError, ValueError, struct.error) as error:
        at = chunk.message_start_time / SECOND
        raise ValueError(f"{path} is damaged at {at:.2f} s of the run: {error!r}") from error


def unpacked(path: Path, chunk: Chunk) -> bytes:
    """The records in a chunk.

    Raises:
        ValueError: It is damaged.
    """
    try:
        told = chunk.uncompressed_size
        if chunk.compression == "zstd":  # the frame tells its size too: as much would be taken
            told = max(told, frame_content_size(chunk.data))
        if told > LARGEST_CHUNK:
            raise ValueError(f"a chunk of {told} bytes")
        stream, length = get_chunk_data_stream(chunk, validate_crc=True)
        return bytes(stream.read(length))
    except (McapError, RuntimeError, ValueError, ZstdError) as error:
        at = chunk.message_start_time / SECOND
        raise ValueError(f"{path} is damaged at {at:.2f} s of the run: {error}") from error


def _messages(data: bytes, found: Contents) -> Iterator[tuple[Channel, int, bytes]]:
    for opcode, content in parts(data):
        if opcode == Opcode.MESSAGE:
            channel, _, time_ns, _ = MESSAGE_FIELDS.unpack_from(content)
            yield found.channels[channel], time_ns, content[MESSAGE_FIELDS.size :]
        elif opcode in (Opcode.CHANNEL, Opcode.SCHEMA):
            found.take(BESIDE_MESSAGES[opcode].read(ReadDataStream(BytesIO(content))))


def parts(data: bytes) -> Iterator[tuple[int, bytes]]:
    """Opcode and content of each record in an unpacked chunk."""
    at = 0
    while at < len(data):
        opcode, length = RECORD_HEAD.unpack_from(data, at)
        start, at = at + RECORD_HEAD.size, at + RECORD_HEAD.size + length
        yield opcode, data[start:at]


def records(path: Path, kinds: Mapping[int, Any]) -> Iterator[Any]:
    """Whole records of some kinds, up to the file's end or to where it was cut.

    Raises:
        ValueError: It is no MCAP file, or a record is damaged.
    """
    size = path.stat().st_size
    with path.open("rb") as stream:
        if stream.read(len(MCAP0_MAGIC)) != MCAP0_MAGIC:
            raise ValueError(f"{path} is no recording: it is not an MCAP file")
        while len(head := stream.read(RECORD_HEAD.size)) == RECORD_HEAD.size:
            opcode, length = RECORD_HEAD.unpack(head)
            end = stream.tell() + length
            if end > size:
                return
            if opcode in kinds:
                yield _record(path, kinds[opcode], stream.read(length))
            stream.seek(end)


def _record(path: Path, kind: Any, data: bytes) -> Any:
    try:
        record = kind.read(ReadDataStream(BytesIO(data)))
        if kind is Attachment:
            (told,) = CHECKSUM.unpack(data[-CHECKSUM.size :])
            if told and told != zlib.crc32(data[: -CHECKSUM.size]):
                raise ValueError("its checksum is wrong")
        return record
    except (McapError, ValueError, struct.error) as error:
        name = kind.__name__.lower()
        raise ValueError(f"{path} is damaged: a record {name} cannot be read") from error
