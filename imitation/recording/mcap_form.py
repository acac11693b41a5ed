"""Whether a file is, byte for byte, what the recorder makes of its content."""

import os
from io import BytesIO
from itertools import zip_longest
from pathlib import Path
from typing import Any, BinaryIO

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Header, Metadata, Schema

from imitation.recording import messages
from imitation.recording.mcap_file import McapFile
from imitation.recording.mcap_quick import QuickWriter
from imitation.recording.mcap_reading import (
    MESSAGE_FIELDS,
    RECORD_HEAD,
    parts,
    records,
    unpacked,
)
from imitation.recording.mcap_recording import Recording
from imitation.recording.step_messages import topics
from imitation.robot import SECOND, Body
from imitation.visual_field import VisualField

MAGIC = 8  # bytes before the first record


class DifferentError(Exception):
    """The recorder would have written otherwise; its text says what."""


def otherwise_written(recording: Recording, body: Body, field: VisualField) -> str:
    """What in the file of a recording the recorder would have written otherwise; empty: nothing.

    The digest tells whether the content is as it was. This tells the rest: types and names,
    times of publication, what stands beside the content, and the index that programs read by.

    Args:
        recording: Its content is as it was written.
        body: The arm.
        field: The visual field.
    """
    with recording.path.open("rb") as stream:
        original = _Original(recording, stream)
        try:
            for topic in recording.topics.keys() - topics(body, field, _is_jpeg(recording)):
                raise DifferentError(f"the topic {topic}")
            _write_again(recording, McapFile(_Again(original), body, field))
            original.check_end()
        except DifferentError as different:
            return f"{different} is not as the recorder wrote it"
    return ""


def _write_again(recording: Recording, file: McapFile) -> None:
    told, jpeg = recording.metadata, _is_jpeg(recording)
    file.begin(told["run"], recording.attachments, told.get("clock"))
    for chunk in recording.chunks():
        file.add_chunk(chunk, jpeg)
    if recording.whole:
        file.seal(told.get("recovered"))


def _is_jpeg(recording: Recording) -> bool:
    return recording.topics["/camera/image"].type == messages.COMPRESSED_IMAGE


class _Original:
    """Stands for the file that would be written: what is written must be there already."""

    def __init__(self, recording: Recording, stream: BinaryIO) -> None:
        self.path, self._whole, self._stream = recording.path, recording.whole, stream

    def write(self, data: bytes) -> None:
        start = self.tell()
        there = self._stream.read(len(data))
        if there != data[: len(there)] or (self._whole and len(there) < len(data)):
            pairs = enumerate(zip_longest(there, data))
            raise DifferentError(self._named(start + next(at for at, (a, b) in pairs if a != b)))

    def check_end(self) -> None:
        """Raise an error when there is more than was to be written."""
        if self._whole and self._stream.read(1):
            raise DifferentError("the end")

    def chunk(self) -> Chunk:
        """The chunk that comes next."""
        at = self.tell()
        opcode, length = RECORD_HEAD.unpack(self._stream.read(RECORD_HEAD.size))
        if opcode != Opcode.CHUNK:
            raise DifferentError(self._named(at))
        found: Chunk = Chunk.read(ReadDataStream(BytesIO(self._stream.read(length))))
        self._stream.seek(at)
        return found

    def tell(self) -> int:
        return self._stream.tell()

    def flush(self) -> None:
        """Nothing waits."""

    def _named(self, at: int) -> str:
        """The record to which the byte `at` belongs."""
        self._stream.seek(MAGIC)
        while len(head := self._stream.read(RECORD_HEAD.size)) == RECORD_HEAD.size:
            opcode, length = RECORD_HEAD.unpack(head)
            if at < self.tell() + length:
                return _beside(opcode, self._stream.read(length))
            self._stream.seek(length, os.SEEK_CUR)
        return "the end"


class _Again(QuickWriter):
    """Packs each chunk as it was packed: that differs between versions of the library."""

    def __init__(self, original: Any) -> None:
        super().__init__(original)
        self._path: Path = original.path

    def start(self, profile: str = "", library: str = "") -> None:
        [header, *_] = records(self._path, {Opcode.HEADER: Header})
        super().start(profile, library or header.library)

    def packed(self, records: bytes) -> bytes:
        chunk = self.stream.chunk()  # type: ignore[attr-defined]
        there = unpacked(self._path, chunk)
        for one, other in zip_longest(parts(there), parts(records)):
            if one != other:
                raise DifferentError(self._inside(one or other))
        return bytes(chunk.data)

    def _inside(self, part: tuple[int, bytes]) -> str:
        opcode, content = part
        if opcode == Opcode.CHANNEL:
            return f"the topic {Channel.read(ReadDataStream(BytesIO(content))).topic}"
        if opcode == Opcode.SCHEMA:
            return f"the type {Schema.read(ReadDataStream(BytesIO(content))).name}"
        if opcode != Opcode.MESSAGE:
            return "a chunk"
        number, _, time_ns, _ = MESSAGE_FIELDS.unpack_from(content)
        named = {channel: topic for topic, channel in self.channels.items()}
        return f"{named.get(number, 'a message')} at {time_ns / SECOND:.3f} s"


def _beside(opcode: int, content: bytes) -> str:
    stream = ReadDataStream(BytesIO(content))
    if opcode == Opcode.METADATA:
        return f"the record {Metadata.read(stream).name}"
    if opcode == Opcode.ATTACHMENT:
        return f"the attachment {Attachment.read(stream).name}"
    return "a chunk" if opcode == Opcode.CHUNK else "the index"
