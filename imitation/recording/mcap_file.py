"""A ROS 2 bag in an MCAP file: how a run is written."""

import fcntl
import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO

from imitation.recording.digest import Digest
from imitation.recording.mcap_quick import QuickWriter
from imitation.recording.messages import definition
from imitation.recording.step_messages import Message, Topic, topics
from imitation.robot import Body
from imitation.visual_field import VisualField

MEDIA_TYPES = {".yaml": "application/yaml", ".json": "application/json", ".urdf": "application/xml"}


class McapFile:
    """The file itself: records at its head, then chunks of whole steps, each with a digest.

    Args:
        writer: Of the file.
        body: The arm.
        field: The visual field.
    """

    def __init__(self, writer: QuickWriter, body: Body, field: VisualField) -> None:
        self._body, self._field = body, field
        self._writer: Any = writer
        self._stream = writer.stream
        self._known: dict[str, Topic] = {}
        self._schemas: dict[str, int] = {}
        self._digest, self._digests = Digest(), 0

    def begin(
        self,
        metadata: Mapping[str, str],
        attachments: Mapping[str, bytes],
        clock: Mapping[str, str] | None,
    ) -> None:
        """Write what belongs to the run as a whole; it survives every kill."""
        self._writer.start(profile="ros2")
        self._record("run", dict(metadata))
        self._record("field", _geometry(self._field))
        if clock is not None:
            self._record("clock", dict(clock))
        for name, data in attachments.items():
            kind = MEDIA_TYPES.get(Path(name).suffix, "application/octet-stream")
            self._writer.add_attachment(0, 0, name, kind, data)
            self._digest.attach(name, data)
        self._stream.flush()

    def add_chunk(self, messages: Sequence[Message], jpeg: bool) -> None:
        """Write messages of whole steps as a chunk; `jpeg` says how the frames come."""
        if not self._known:
            self._known = topics(self._body, self._field, jpeg)
        for topic in dict.fromkeys(message.topic for message in messages):
            if topic not in self._writer.channels:
                self._open_channel(topic)
        self._writer.add_chunk(messages)
        self._digest.add(messages)
        self._write_digest()

    def seal(self, recovered: Mapping[str, str] | None = None) -> None:
        """Write the file's summary, and before it what a recovery had to tell."""
        if not self._digests:
            self._write_digest()
        if recovered is not None:
            self._writer.add_metadata("recovered", dict(recovered))
        self._writer.finish()
        self._stream.flush()

    def close(self) -> None:
        """Close the file; harmless when repeated."""
        self._stream.close()

    def _record(self, name: str, told: dict[str, str]) -> None:
        self._writer.add_metadata(name, told)
        self._digest.record(name, told)

    def _write_digest(self) -> None:
        self._digests += 1
        self._writer.add_metadata(f"digest/{self._digests:04d}", self._digest.values())
        self._stream.flush()

    def _open_channel(self, name: str) -> None:
        topic = self._known[name]
        if topic.type not in self._schemas:
            text = definition(topic.type).encode()
            self._schemas[topic.type] = self._writer.register_schema(topic.type, "ros2msg", text)
        names = {"names": json.dumps(topic.names)} if topic.names else {}
        self._writer.register_channel(name, "cdr", self._schemas[topic.type], names)


def new_file(path: Path) -> BinaryIO:
    """A file that does not exist yet, locked while it is written."""
    stream = path.open("xb")
    with suppress(OSError):  # not every file system can tell that it is being written
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    return stream


def _geometry(field: VisualField) -> dict[str, str]:
    """What a reader needs to draw the areas."""
    x_edges, y_edges = field.edges
    return {
        "name": field.name,
        "x_edges_px": json.dumps(x_edges.tolist()),
        "y_edges_px": json.dumps(y_edges.tolist()),
    }
