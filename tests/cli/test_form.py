"""What stands beside the content, and how it is found, cannot be changed unseen either."""

import dataclasses
import json
import shutil
import struct
import zlib

import pytest
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Channel, Message, Schema
from tampering import rewrite

from imitation.recording.mcap_reading import END, RECORD_HEAD, parts
from imitation.recording.messages import JOINT_STATE


@pytest.fixture(scope="module")
def run(reached_shortly):
    return reached_shortly


def of(kind, named, /, **new):
    """Changes the channel or schema of a name."""

    def form(record):
        called = getattr(record, "topic", getattr(record, "name", None))
        chosen = (type(record), called) == (kind, named)
        return dataclasses.replace(record, **new) if chosen else record

    return form


def tenth(**new):
    """Changes the tenth message of all."""
    count = iter(range(10**6))

    def form(record):
        chosen = isinstance(record, Message) and next(count) == 10
        return dataclasses.replace(record, **new) if chosen else record

    return form


ENTRIES = {"names": json.dumps(["noise level", "gain", "distance"])}


@pytest.mark.parametrize(
    ("form", "told"),
    [
        (of(Schema, JOINT_STATE, name="std_msgs/msg/String"), "the type std_msgs/msg/String"),
        (of(Schema, JOINT_STATE, data=b"float64[] speed"), f"the type {JOINT_STATE}"),
        (of(Schema, JOINT_STATE, encoding="ros2idl"), f"the type {JOINT_STATE}"),
        (of(Channel, "/dynamics", metadata=ENTRIES), "the topic /dynamics"),
        (of(Channel, "/dynamics", metadata={}), "the topic /dynamics"),
        (of(Channel, "/hand", message_encoding="json"), "the topic /hand"),
        (tenth(publish_time=7), "at 0.000 s"),
        (tenth(sequence=7), "at 0.000 s"),
    ],
)
def test_what_describes_the_messages_cannot_be_changed(imitate, run, form, told):
    rewrite(run / "run.mcap", imitate.folder / "x.mcap", form=form)
    result = imitate("verify", "x.mcap")
    assert result.exit_code == 1
    assert result.stderr.startswith(f"imitate: {told}" if told[0] == "t" else "imitate: /")
    assert told in result.stderr and "is not as the recorder wrote it" in result.stderr


@pytest.mark.parametrize("names", ["}{", "7", "[" * 5000])
def test_names_that_are_no_list_are_one_line(imitate, run, names):
    form = of(Channel, "/dynamics", metadata={"names": names})
    rewrite(run / "run.mcap", imitate.folder / "x.mcap", form=form)
    result = imitate("verify", "x.mcap")
    assert result.exit_code == 2 and result.stderr.count("\n") == 1
    assert "the names on /dynamics" in result.stderr


def summarised(path, edit):
    """Have `edit` change the records of a file's summary, and make its checksum right again."""
    data = path.read_bytes()
    _, length, start, offsets, _, magic = END.unpack(data[-END.size :])
    told = b"".join(
        RECORD_HEAD.pack(opcode, len(content)) + content
        for opcode, content in edit(list(parts(data[start : -END.size])))
    )
    footer = struct.pack("<BQQQ", Opcode.FOOTER, length, start, offsets)
    checksum = struct.pack("<I", zlib.crc32(told + footer))
    path.write_bytes(data[:start] + told + footer + checksum + magic)


def test_what_the_index_hides_is_found(imitate, run):
    """Other programs read by the index: what it leaves out is not there for them."""
    path = imitate.folder / "x.mcap"
    shutil.copy(run / "run.mcap", path)

    def without_the_last_chunk(records):
        last = max(at for at, one in enumerate(records) if one[0] == Opcode.CHUNK_INDEX)
        return records[:last] + records[last + 1 :]

    summarised(path, without_the_last_chunk)
    with path.open("rb") as stream:
        seen = sum(1 for _ in make_reader(stream).iter_messages("/joint_states"))
    assert 0 < seen < 30
    result = imitate("verify", "x.mcap")
    assert result.exit_code == 1 and "the index is not as the recorder wrote it" in result.stderr


def test_what_is_added_is_found(imitate, run):
    path = imitate.folder / "x.mcap"
    shutil.copy(run / "run.mcap", path)
    path.write_bytes(path.read_bytes() + path.read_bytes()[-8:])
    result = imitate("verify", "x.mcap")
    assert result.exit_code in (1, 2) and result.stderr.count("\n") == 1


def test_two_messages_of_a_step_cannot_change_places(imitate, run):
    """The ideal arm is sent what the guard left: these two say the same, in another order."""
    first, second = "/joint_command/limited", "/joint_command/sent"
    renamed = {first: second, second: first}

    def form(record):
        return (
            dataclasses.replace(record, topic=renamed.get(record.topic, record.topic))
            if isinstance(record, Channel)
            else record
        )

    rewrite(run / "run.mcap", imitate.folder / "x.mcap", form=form, sealed=True)
    result = imitate("verify", "x.mcap")
    assert result.exit_code == 1 and "order of messages" in result.stderr


def test_an_end_that_was_taken_away_is_told_by_the_metrics(imitate, run):
    folder = imitate.folder / "run"
    shutil.copytree(run, folder)
    told = json.loads((folder / "metrics.json").read_text())
    (folder / "metrics.json").write_text(json.dumps(told | {"steps": told["steps"] + 5}))
    result = imitate("verify", "run")
    (folder / "metrics.json").write_text(json.dumps(told))
    assert result.exit_code == 1 and "metrics.json tells of" in result.stderr
