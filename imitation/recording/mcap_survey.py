"""The messages of an MCAP file of any program, in chunks or loose: when they came, how large."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk

from imitation.recording.mcap_reading import (
    BESIDE_MESSAGES,
    MESSAGE_FIELDS,
    Contents,
    is_whole,
    records,
    told_in,
)


class Loose(NamedTuple):
    """A message outside a chunk."""

    channel: int
    time_ns: int
    size: int  # [bytes]

    @classmethod
    def read(cls, stream: ReadDataStream) -> "Loose":
        """From a record."""
        channel, _, time_ns, _ = MESSAGE_FIELDS.unpack(stream.read(MESSAGE_FIELDS.size))
        return cls(channel, time_ns, len(stream.read(-1)))


def sizes(path: Path, found: Contents) -> Iterator[tuple[int, Channel, int]]:
    """Time [ns], channel and size [bytes] of each message.

    Args:
        path: The file.
        found: Learns on the way what else the file holds.

    Raises:
        ValueError: It is no MCAP file, or it is damaged.
    """
    for record in records(path, {**BESIDE_MESSAGES, Opcode.CHUNK: Chunk, Opcode.MESSAGE: Loose}):
        if isinstance(record, Chunk):
            for channel, time_ns, data in told_in(path, record, found):
                yield time_ns, channel, len(data)
        elif isinstance(record, Loose):
            if record.channel not in found.channels:
                raise ValueError(f"{path} is damaged: a message has no channel")
            yield record.time_ns, found.channels[record.channel], record.size
        else:
            found.take(record)
    found.whole = is_whole(path)
