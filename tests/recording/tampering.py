"""Changes one message of a recording as someone might who makes all checksums right again."""

from collections.abc import Callable
from pathlib import Path

from mcap.reader import make_reader
from mcap.records import Attachment, Channel, Chunk, Metadata, Schema
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.writer import CompressionType, Writer

Change = Callable[[str, int, bytes], bytes]  # topic, number of the message, data -> data


def rewrite(source: Path, target: Path, change: Change) -> None:
    """Write `source` again, message by message, each as `change` returns it."""
    numbers: dict[str, int] = {}
    channels: dict[int, str] = {}
    with source.open("rb") as stream, target.open("wb") as out:
        writer = Writer(out, 1 << 40, CompressionType.ZSTD)
        writer.start(profile="ros2")
        for record in StreamReader(stream, emit_chunks=True).records:
            if isinstance(record, Metadata):
                writer.add_metadata(record.name, record.metadata)
            elif isinstance(record, Attachment):
                writer.add_attachment(0, 0, record.name, record.media_type, record.data)
            elif isinstance(record, Chunk):
                for inner in breakup_chunk(record):
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
                        writer.add_message(inner.channel_id, at, data, at)
                writer.flush()
        writer.finish()


def counts(path: Path) -> dict[str, int]:
    """How many messages each topic has."""
    with path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
        counted = summary.statistics.channel_message_counts
        return {summary.channels[channel].topic: count for channel, count in counted.items()}
