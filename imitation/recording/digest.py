"""A digest of what a recording says, whatever its chunks, compression and tool."""

import hashlib
import struct
from collections import defaultdict

OVERALL = "all"  # key of the digest over the digests of all topics
_ENTRY = struct.Struct("<QQ")  # log_time [ns], length of the data [bytes]


class Digest:
    """SHA-256 over the content so far, for each topic.

    A topic's digest runs over its name and a zero byte, then over each message in the order
    written: log_time and length of the data, 8 bytes each, little-endian, and the data.
    """

    def __init__(self) -> None:
        self._hashes: dict[str, hashlib._Hash] = {}
        self._pending: defaultdict[str, list[bytes]] = defaultdict(list)

    def add(self, topic: str, time_ns: int, data: bytes) -> None:
        """One more message."""
        self._pending[topic] += (_ENTRY.pack(time_ns, len(data)), data)

    def values(self) -> dict[str, str]:
        """Hexadecimal digest of each topic, sorted, and `all` over the lines `digest  topic`."""
        # Hashed in one piece for each topic: long pieces are hashed without holding the GIL.
        for topic, pieces in self._pending.items():
            if topic not in self._hashes:
                self._hashes[topic] = hashlib.sha256(topic.encode() + b"\0")
            self._hashes[topic].update(b"".join(pieces))
        self._pending.clear()
        topics = {topic: self._hashes[topic].hexdigest() for topic in sorted(self._hashes)}
        lines = "".join(f"{value}  {topic}\n" for topic, value in topics.items())
        return topics | {OVERALL: hashlib.sha256(lines.encode()).hexdigest()}
