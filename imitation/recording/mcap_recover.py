"""Makes a cut recording whole again: all of it up to the cut, and the summary that it lacked."""

import os
from contextlib import suppress
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Metadata, Schema

from imitation.recording.digest import RECORDS, Digest
from imitation.recording.mcap_quick import QuickWriter
from imitation.recording.mcap_reading import MESSAGE_FIELDS, parts, records, unpacked
from imitation.recording.run_files import free
from imitation.recording.step_messages import Message

KINDS: dict[int, Any] = {
    Opcode.METADATA: Metadata,
    Opcode.ATTACHMENT: Attachment,
    Opcode.CHUNK: Chunk,
}


@dataclass
class Recovery:
    """What was kept of a cut recording.

    Args:
        cut: The cut recording.
        stream: Where the whole one is written.
    """

    cut: Path
    stream: BinaryIO
    steps: int = 0
    last_ns: int = 0  # time of the last command [ns]
    damage: str = ""  # why it ends before the cut; empty: it does not
    _digest: Digest = field(default_factory=Digest)
    _names: set[str] = field(default_factory=set)
    _digests: int = 0
    _chunks: int = 0
    _topics: dict[int, str] = field(default_factory=dict)

    def run(self) -> None:
        """Write everything up to the cut, or to what is damaged before it."""
        writer: Any = QuickWriter(self.stream)
        writer.start(profile="ros2")
        try:
            for record in records(self.cut, KINDS):
                self._copy(writer, record)
        except ValueError as error:
            self.damage = str(error)
        if not {"run", "field"} <= self._names:
            raise ValueError(
                f"{self.cut} is no recording of this bench: its record `run` is missing"
            )
        if self._digests < self._chunks or not self._chunks:  # the cut took the last one
            writer.add_metadata(f"digest/{self._digests + 1:04d}", self._digest.values())
        told = {"bytes": str(self.cut.stat().st_size), "damage": self.damage}
        writer.add_metadata("recovered", told)
        writer.finish()
        self.stream.flush()
        os.fsync(self.stream.fileno())

    def _copy(self, writer: Any, record: Any) -> None:
        if isinstance(record, Metadata):
            self._names.add(record.name)
            self._digests += record.name.startswith("digest/")
            if record.name in RECORDS:
                self._digest.record(record.name, record.metadata)
            writer.add_metadata(record.name, record.metadata)
        elif isinstance(record, Attachment):
            times = (record.create_time, record.log_time)
            self._digest.attach(record.name, record.data)
            writer.add_attachment(*times, record.name, record.media_type, record.data)
        else:
            self._copy_chunk(writer, list(parts(unpacked(self.cut, record))))
            self._chunks += 1

    def _copy_chunk(self, writer: Any, told: list[tuple[int, bytes]]) -> None:
        messages = []
        for opcode, content in told:
            stream = ReadDataStream(BytesIO(content))
            if opcode == Opcode.SCHEMA:
                schema = Schema.read(stream)
                writer.register_schema(schema.name, schema.encoding, schema.data)
            elif opcode == Opcode.CHANNEL:
                one = Channel.read(stream)
                self._topics[one.id] = one.topic
                encoding, metadata = one.message_encoding, one.metadata
                writer.register_channel(one.topic, encoding, one.schema_id, metadata)
            elif opcode == Opcode.MESSAGE:
                channel, _, time_ns, _ = MESSAGE_FIELDS.unpack_from(content)
                data = content[MESSAGE_FIELDS.size :]
                messages.append(Message(self._topics[channel], time_ns, data))
        writer.add_chunk(messages)
        self._digest.add(messages)
        for message in messages:
            if message.topic == "/joint_command/sent":
                self.steps, self.last_ns = self.steps + 1, message.time_ns


def recover(cut: Path) -> tuple[Recovery, Path]:
    """Put the whole recording in the place of the cut one, which is kept beside it.

    Returns:
        What was kept, and where the cut recording is now.

    Raises:
        ValueError: It is no recording of this bench.
    """
    beside = cut.with_name(f"{cut.stem}.recovering")
    try:
        with beside.open("wb") as stream:
            recovery = Recovery(cut, stream)
            recovery.run()
        kept = free(cut.with_name(f"{cut.stem}.truncated.mcap"))
        os.link(cut, kept)  # at every moment both are there under a name
        beside.replace(cut)
    finally:
        with suppress(FileNotFoundError):
            beside.unlink()
    return recovery, kept
