"""Programs that are not ours read what we write, with equal values."""

import math
import subprocess
import sys
from collections import defaultdict

import made_up
import numpy as np
import rerun as rr
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader

from imitation.recording.mcap_recording import Recording
from imitation.recording.rerun_view import derive


def plain(value):
    """A message of any library as dicts, lists and numbers; its constants are left out."""
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, bytes | bytearray | memoryview | list | tuple):
        return [plain(one) for one in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else repr(value)
    names = getattr(value, "__dataclass_fields__", None) or getattr(value, "__slots__", None)
    if names is None or isinstance(value, str):
        return value
    fields = [name for name in names if not name.isupper() and not name.startswith("_")]
    return {name: plain(getattr(value, name)) for name in fields}


def by_topic(read):
    found = defaultdict(list)
    for topic, time_ns, message in read:
        found[topic].append((time_ns, plain(message)))
    return dict(found)


def ours(path):
    recording = Recording.open(path)
    return by_topic(
        (topic, *told) for topic in recording.topics for told in recording.messages(topic)
    )


def test_every_topic_is_read_back_by_mcap_ros2_support(record):
    path = record(steps=12)
    with path.open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        theirs = by_topic(
            (channel.topic, message.log_time, decoded)
            for _, channel, message, decoded in reader.iter_decoded_messages()
        )
    assert theirs == ours(path)
    assert theirs.keys() == made_up.all_topics().keys()


def test_every_topic_is_read_back_by_rosbags(record):
    path = record(steps=12)
    with AnyReader([path]) as reader:
        theirs = by_topic(
            (connection.topic, time_ns, reader.deserialize(data, connection.msgtype))
            for connection, time_ns, data in reader.messages()
        )
    assert theirs == ours(path)


def rerun(*words):
    call = [sys.executable, "-m", "rerun_cli", *words]
    return subprocess.run(call, capture_output=True, text=True, check=False)


def test_rerun_verifies_the_derived_file(record, tmp_path):
    derive(record().parent, tmp_path / "run.rrd")
    told = rerun("rrd", "verify", str(tmp_path / "run.rrd"))
    assert told.returncode == 0, told.stderr


def test_rerun_checks_the_recording(record):
    told = rerun("mcap", "check", "--full", str(record()))
    assert told.returncode == 0, told.stdout + told.stderr


def test_rerun_opens_the_bare_recording_with_pictures_and_named_curves(record):
    found = defaultdict(dict)
    stream = rr.chunk.McapReader(record(), timeline_type="duration_ns").stream()
    for chunk in stream.to_chunks():
        batch = chunk.to_record_batch()
        found[str(chunk.entity_path)] |= dict(zip(batch.schema.names, batch.columns, strict=True))
    assert "Image:buffer" in found["/camera/image"]
    assert "TextLog:text" in found["/events"]
    for entity in ("/joint_states/position", "/joint_command/sent/velocity"):
        names = found[entity]["SeriesLines:names"][0].as_py()
        assert names == list(made_up.BODY.joint_names)
        assert "Scalars:scalars" in found[entity]
    assert "Scalars:scalars" in found["/dynamics"]
