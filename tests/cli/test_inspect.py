"""What a recording holds is told on one screen, whoever wrote it."""

import json
import sqlite3
from contextlib import closing

import numpy as np
import pytest
from mcap.writer import IndexType, Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as BagWriter
from rosbags.typesys import Stores, get_typestore

from imitation.recording.mcap_recording import Recording


def test_a_run_is_told(imitate, learned):
    told = imitate("inspect", str(learned))
    assert told.exit_code == 0, told.output
    for word in (
        "imitate learn-map",
        "robot=ideal",
        "whole, done",
        "/joint_states",
        "areas_learned",
    ):
        assert word in told.stdout
    assert Recording.open(learned).digest()["all"][:4] in told.stdout
    assert f"imitate reach map={learned}" not in told.stdout.split("next")[0]
    assert len(told.stdout.splitlines()) <= 50


def test_a_run_is_told_to_scripts(imitate, learned):
    told = json.loads(imitate("inspect", str(learned), "--json").stdout)
    assert (told["command"], told["seed"], told["whole"]) == ("learn-map", "0", True)
    assert told["settings"] == ["robot=ideal"]
    assert told["digest_matches"] and told["digest"] == Recording.open(learned).digest()
    (image,) = [one for one in told["topics"] if one["topic"] == "/camera/image"]
    assert image["messages"] == told["metrics"]["steps"]
    assert image["rate_hz"] == pytest.approx(25)
    assert image["largest_gap_s"] == pytest.approx(0.04)


def test_settings_name_what_was_chosen_and_set(imitate, learned):
    words = ("controller=nearest", "reach.limit=0.4", "reach.required=0", "camera.delay_frames=2")
    imitate("reach", "robot=ideal", f"map={learned}", *words, "out=run")
    told = json.loads(imitate("inspect", "run", "--json").stdout)
    assert set(told["settings"]) == {"robot=ideal", *words}


def test_a_truncated_run_is_told_with_the_way_out(imitate, learned, tmp_path):
    data = (learned / "run.mcap").read_bytes()
    (tmp_path / "run.mcap").write_bytes(data[: len(data) // 2])
    told = imitate("inspect", str(tmp_path / "run.mcap"))
    assert told.exit_code == 0
    assert "truncated" in told.stdout and "imitate recover" in told.stdout


def test_a_changed_run_is_told(imitate, learned, tmp_path):
    from tampering import rewrite

    def change(topic, number, data):
        return data[:-1] + b"\x01" if (topic, number) == ("/camera/image", 3) else data

    rewrite(learned / "run.mcap", tmp_path / "run.mcap", change)
    assert "does NOT match" in imitate("inspect", str(tmp_path)).stdout


@pytest.mark.parametrize("chunked", [True, False])
def test_an_mcap_of_another_program_is_listed(imitate, tmp_path, chunked):
    path = tmp_path / "other.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream, use_chunking=chunked)
        writer.start()
        schema = writer.register_schema("Pose", "jsonschema", b"{}")
        channel = writer.register_channel("/pose", "json", schema)
        for number in range(5):
            writer.add_message(channel, number * 100_000_000, b"{}", 0)
        writer.finish()
    told = json.loads(imitate("inspect", str(path), "--json").stdout)
    assert told["kind"] == "MCAP file, no profile"
    (topic,) = told["topics"]
    assert (topic["topic"], topic["type"], topic["messages"]) == ("/pose", "Pose", 5)
    assert topic["rate_hz"] == pytest.approx(10)
    assert imitate("inspect", str(path)).exit_code == 0


@pytest.mark.parametrize("storage", [StoragePlugin.SQLITE3, StoragePlugin.MCAP])
def test_a_ros_2_bag_is_listed(imitate, tmp_path, storage):
    store = get_typestore(Stores.ROS2_JAZZY)
    kind = "std_msgs/msg/Float64"
    with BagWriter(tmp_path / "bag", version=9, storage_plugin=storage) as bag:
        connection = bag.add_connection("/number", kind, typestore=store)
        for number in range(3):
            data = store.serialize_cdr(store.types[kind](np.float64(number)), kind)
            bag.write(connection, number * 500_000_000, data)
    told = json.loads(imitate("inspect", str(tmp_path / "bag"), "--json").stdout)
    assert "ROS 2 bag" in told["kind"]
    (topic,) = told["topics"]
    assert (topic["topic"], topic["type"], topic["messages"]) == ("/number", kind, 3)
    assert topic["largest_gap_s"] == 0.5


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("text.mcap", b"hello"),
        ("empty.mcap", b""),
        ("bag.db3", b"hello"),
        ("head.mcap", b"\x89MCAP0\r\n" + b"\x01" + (1 << 60).to_bytes(8, "little")),
        ("noise.mcap", b"\x89MCAP0\r\n" + bytes(np.random.default_rng(0).bytes(4000))),
    ],
)
def test_a_broken_file_is_one_line(imitate, tmp_path, name, data):
    (tmp_path / name).write_bytes(data)
    told = imitate("inspect", str(tmp_path / name))
    assert told.exit_code in (0, 2)
    assert "Traceback" not in told.stderr and len(told.stderr.splitlines()) <= 1


def test_a_database_that_is_no_bag_is_one_line(imitate, tmp_path):
    with closing(sqlite3.connect(tmp_path / "a.db3")) as database:
        database.execute("CREATE TABLE topics (id, name, type)")
        database.commit()
    told = imitate("inspect", str(tmp_path / "a.db3"))
    assert told.exit_code == 0
    told = imitate("inspect", str(tmp_path))
    assert told.exit_code == 2 and "no recording in" in told.stderr


def test_messages_out_of_order_last_from_the_first_to_the_last(imitate, tmp_path):
    """And a file without an index is none of ours, but sound."""
    with (tmp_path / "a.mcap").open("wb") as stream:
        writer = Writer(stream, index_types=IndexType.NONE, use_summary_offsets=False)
        writer.start(profile="ros2")
        channel = writer.register_channel("/late", "json", 0)
        for time_ns in (9_000_000_000, 5_000_000_000):
            writer.add_message(channel, time_ns, b"{}", time_ns)
        writer.finish()
    told = json.loads(imitate("inspect", "a.mcap", "--json").stdout)
    assert told["lasted_s"] == 4.0 and told["topics"][0]["messages"] == 2
    for command in ("verify", "recover"):
        assert "its record `run` is missing" in imitate(command, "a.mcap").stderr
