"""A digest of what a recording says, whatever its chunks, compression and tool."""

import hashlib
import struct
from collections import defaultdict
from collections.abc import Iterable

from imitation.recording.step_messages import Message

OVERALL = "all"  # key of the digest over the digests of all topics
_ENTRY = struct.Struct("<QQ")  # log_time [ns], length of the data [bytes]


class Digest:
    """SHA-256 over the content so far, for each topic.

    A topic's digest runs over its name and a zero byte, then over each message in the order
    written: log_time and length of the data, 8 bytes each, little-endian, and the data.
    """

    def __init__(self) -> None:
        self._hashes: dict[str, hashlib._Hash] = {}

    def add(self, messages: Iterable[Message]) -> None:
        """More messages."""
        told: defaultdict[str, list[bytes]] = defaultdict(list)
        for topic, time_ns, data in messages:
            told[topic] += (_ENTRY.pack(time_ns, len(data)), data)
        for topic, content in told.items():
            if topic not in self._hashes:
                self._hashes[topic] = hashlib.sha256(topic.encode() + b"\0")
            # In one piece, so that the thread gives up the GIL, and waits for it again, but once.
            self._hashes[topic].update(b"".join(content))

    def values(self) -> dict[str, str]:
        """Hexadecimal digest of each topic, sorted, and `all` over the lines `digest  topic`."""
        topics = {topic: self._hashes[topic].hexdigest() for topic in sorted(self._hashes)}
        lines = "".join(f"{value}  {topic}\n" for topic, value in topics.items())
        return topics | {OVERALL: hashlib.sha256(lines.encode()).hexdigest()}
