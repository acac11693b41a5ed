"""The recording `run.mcap`, read again."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from imitation.recording import messages
from imitation.recording.digest import ATTACHMENT, RECORD, RECORDS, Digest
from imitation.recording.mcap_reading import Contents, chunks, contents
from imitation.recording.run_files import file_in
from imitation.recording.step_messages import Message, Topic


def digest_number(name: str) -> int:
    """Which of the digests a record is, from 1; 0: none of them."""
    word, _, digits = name.partition("/")
    return int(digits) if word == "digest" and re.fullmatch("[0-9]{1,18}", digits) else 0


def recording_in(path: Path) -> Path:
    """The file itself, or that of a run folder.

    Raises:
        ValueError: There is none.
    """
    file = file_in(path, "run.mcap")
    if not file.is_file():
        raise ValueError(f"no recording at {file}; give a run folder or its run.mcap")
    return file


class Recording:
    """A recording as it was written, whole or cut.

    Attributes:
        path: The file.
        whole: Whether it was closed as it should be; a killed run's is not.
        metadata: Its records by name: `run`, `digest/0001`, ...
        attachments: The files that belong to the run, by name.
    """

    def __init__(self, path: Path, found: Contents) -> None:
        self.path, self._found = path, found
        self.whole, self.metadata = found.whole, found.metadata
        self.attachments = found.attachments

    @classmethod
    def open(cls, path: Path) -> "Recording":
        """Open a recording, or the one in a run folder.

        Raises:
            ValueError: There is none, or it is none of this bench; the message says which.
        """
        file = recording_in(path)
        found = contents(file)
        if found.profile != "ros2":
            raise ValueError(f"{file} is no recording of this bench: it is not a ROS 2 bag")
        if not {"run", "field"} <= found.metadata.keys():
            raise ValueError(f"{file} is no recording of this bench: its record `run` is missing")
        if found.twice:
            raise ValueError(f"{file} is damaged: it says {found.twice} twice, not the same")
        return cls(file, found)

    @property
    def topics(self) -> dict[str, Topic]:
        """Every topic that was written, with its type and the names of its entries."""
        channels, schemas = self._found.channels.values(), self._found.schemas
        return {
            channel.topic: Topic(schemas[channel.schema_id].name, self._names(channel))
            for channel in channels
        }

    def _names(self, channel: Any) -> tuple[str, ...]:
        told = channel.metadata.get("names", "[]")
        try:
            return tuple(str(name) for name in list(json.loads(told)))
        except (RecursionError, TypeError, ValueError):
            raise ValueError(f"{self.path} is damaged: the names on {channel.topic}") from None

    def chunks(self) -> Iterator[list[Message]]:
        """All messages, chunk by chunk, in the order written; a chunk holds whole steps.

        Raises:
            ValueError: The file is damaged.
        """
        return chunks(self.path, self._found)

    def messages(self, topic: str) -> Iterator[tuple[int, Any]]:
        """Time [ns] and decoded message of each message of a topic; none if it was not written.

        Raises:
            ValueError: The file is damaged.
        """
        if topic not in self.topics:
            return
        kind = self.topics[topic].type
        for chunk in self.chunks():
            for message in chunk:
                if message.topic == topic:
                    yield message.time_ns, messages.decoded(message.data, kind)

    def digest(self) -> dict[str, str]:
        """The last digest that was written: the seal of a whole recording; empty if none."""
        last = max(self.metadata, key=digest_number)
        return self.metadata[last] if digest_number(last) else {}

    def recomputed_digest(self) -> dict[str, str]:
        """The same, from what the messages say.

        Raises:
            ValueError: The file is damaged.
        """
        digest = self.begun_digest()
        for chunk in self.chunks():
            digest.add(chunk)
        return digest.values()

    def begun_digest(self) -> Digest:
        """The digest of what stands before the messages; of nothing in files of older versions."""
        digest = Digest()
        if not any(name.startswith((ATTACHMENT, RECORD)) for name in self.digest()):
            return digest
        for name in RECORDS:
            if name in self.metadata:
                digest.record(name, self.metadata[name])
        for name, data in self.attachments.items():
            digest.attach(name, data)
        return digest
