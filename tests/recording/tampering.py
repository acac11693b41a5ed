"""Changes one part of a recording as someone might who makes all checksums right again."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from mcap.reader import make_reader
from mcap.records import Attachment, Channel, Chunk, Metadata, Schema
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.writer import CompressionType, Writer

from imitation.recording.digest import RECORDS, Digest
from imitation.recording.step_messages import Message

Change = Callable[[str, int, bytes], bytes]  # topic, number of the message, data -> data
Attach = Callable[[str, bytes], bytes]  # name, data -> data
Form = Callable[[Any], Any]  # schema, channel or message -> that
Tell = Callable[[str, dict[str, str]], dict[str, str]]  # name, what it tells -> that


def as_it_is(topic: str, number: int, data: bytes) -> bytes:
    """A message."""
    return data


def rewrite(
    source: Path,
    target: Path,
    change: Change = as_it_is,
    attach: Attach = lambda name, data: data,
    tell: Tell = lambda name, told: told,
    sealed: bool = False,
    renamed: str | None = None,
    form: Form = lambda record: record,
) -> None:
    """Write `source` again, each part as `change`, `attach`, `tell` or `form` returns it.

    With `sealed`, the digests are made anew as well; the last attachment is `renamed`.
    """
    numbers: dict[str, int] = {}
    channels: dict[int, str] = {}
    digest = Digest()
    with source.open("rb") as stream, target.open("wb") as out:
        writer = Writer(out, 1 << 40, CompressionType.ZSTD)
        writer.start(profile="ros2")
        for record in StreamReader(stream, emit_chunks=True).records:
            if isinstance(record, Metadata):
                told = tell(record.name, record.metadata)
                if record.name in RECORDS:
                    digest.record(record.name, told)
                resealed = sealed and record.name.startswith("digest/")
                writer.add_metadata(record.name, digest.values() if resealed else told)
            elif isinstance(record, Attachment):
                data = attach(record.name, record.data)
                last = renamed is not None and record.name.endswith(".urdf")
                name = str(renamed) if last else record.name
                digest.attach(name, data)
                writer.add_attachment(0, 0, name, record.media_type, data)
            elif isinstance(record, Chunk):
                for inner in map(form, breakup_chunk(record)):
                    if isinstance(inner, Schema):
                        writer.register_schema(inner.name, inner.encoding, inner.data)
                    elif isinstance(inner, Channel):
                        channels[inner.id] = inner.topic
                        writer.register_channel(
                            inner.topic, inner.message_encoding, inner.schema_id, inner.metadata
                        )
                    else:
                        topic = channels[inner.channel_id]
                        number = numbers[topic] = numbers.get(topic, -1) + 1
                        data = change(topic, number, inner.data)
                        at = inner.log_time
                        digest.add([Message(topic, at, data)])
                        times = (inner.publish_time, inner.sequence)
                        writer.add_message(inner.channel_id, at, data, *times)
                writer.flush()
        writer.finish()


def counts(path: Path) -> dict[str, int]:
    """How many messages each topic has."""
    with path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
        counted = summary.statistics.channel_message_counts
        return {summary.channels[channel].topic: count for channel, count in counted.items()}
