"""A digest of what a recording says, whatever its chunks, compression and tool."""

import hashlib
import struct
from collections import defaultdict
from collections.abc import Iterable, Mapping

from imitation.recording.step_messages import Message

OVERALL = "all"  # key of the digest over all digests
ATTACHMENT, RECORD = "attachment:", "record:"  # before the names of what is no topic
RECORDS = ("run", "field", "clock")  # written before the first message
_ENTRY = struct.Struct("<QQ")  # log_time [ns], length of the data [bytes]


class Digest:
    """SHA-256 over the content so far, for each topic and for each thing beside the messages.

    A topic's digest runs over its name and a zero byte, then over each message in the order
    written: log_time and length of the data, 8 bytes each, little-endian, and the data. That of an
    attachment is its SHA-256; that of a record runs over its keys and values, sorted, each
    followed by a zero byte.
    """

    def __init__(self) -> None:
        self._hashes: dict[str, hashlib._Hash] = {}
        self._beside: dict[str, str] = {}

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

    def attach(self, name: str, data: bytes) -> None:
        """What is attached."""
        self._beside[f"{ATTACHMENT}{name}"] = hashlib.sha256(data).hexdigest()

    def record(self, name: str, told: Mapping[str, str]) -> None:
        """What a metadata record tells."""
        text = "".join(f"{key}\0{told[key]}\0" for key in sorted(told))
        self._beside[f"{RECORD}{name}"] = hashlib.sha256(text.encode()).hexdigest()

    def values(self) -> dict[str, str]:
        """Hexadecimal digest of each, sorted by name, and `all` over the lines `digest  name`."""
        topics = {topic: one.hexdigest() for topic, one in self._hashes.items()}
        told = dict(sorted((topics | self._beside).items()))
        lines = "".join(f"{value}  {name}\n" for name, value in told.items())
        return told | {OVERALL: hashlib.sha256(lines.encode()).hexdigest()}
