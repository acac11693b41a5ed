import dataclasses
import subprocess
import sys
import time
from pathlib import Path

import made_up
import numpy as np
import pytest
from mcap.writer import CompressionType, Writer
from rosbags.highlevel import AnyReader
from small_files import files_up_to

from imitation.recording import mcap_file, recorder
from imitation.recording.mcap_recording import Recording
from imitation.recording.recorder import Recorder, RecorderError, bounds

KILLED = """
import sys; sys.path.insert(0, {tests!r})
import time, made_up
from pathlib import Path
recorder = made_up.recorder(Path({path!r}), reproducible={reproducible})
for sample, truths in made_up.run(100_000):
    recorder.write(sample, truths)
    print(sample.seen.time_ns, flush=True)
    time.sleep({pause})
"""


def test_every_topic_is_read_back_by_rosbags(record):
    with AnyReader([record()]) as reader:
        types = {connection.topic: connection.msgtype for connection in reader.connections}
        assert types == {name: topic.type for name, topic in made_up.all_topics().items()}
        read = {
            (connection.topic, time_ns): reader.deserialize(data, connection.msgtype)
            for connection, time_ns, data in reader.messages()
        }
    (sample, _), *_ = made_up.run(1)
    image = read["/camera/image", 0]
    assert np.array_equal(image.data.reshape(120, 160, 3), sample.seen.frame)
    assert read["/joint_states", 0].name == list(made_up.BODY.joint_names)
    assert np.array_equal(read["/joint_states", 0].position, sample.seen.posture)
    assert np.array_equal(read["/attractors/pull", 0].data, sample.decision.shares.ravel())
    hand = read["/hand", 0].point
    assert (hand.x, hand.y) == tuple(sample.percept.hand)


def test_messages_of_a_step_come_as_senses_decision_applied(record):
    chunk = next(Recording.open(record()).chunks())
    order = [message.topic for message in chunk if message.time_ns == made_up.PERIOD_NS]
    parts = ("/joint_states", "/visual_input", "/selection", "/joint_command/sent", "/truth/hand")
    # The truth of a step's end is told with that step, so it comes before the next one.
    order = [topic for topic in order if topic in parts]
    assert order == ["/truth/hand", *parts[:-1]]


def test_same_run_gives_the_same_bytes(record):
    assert record("a.mcap").read_bytes() == record("b.mcap").read_bytes()


def test_messages_are_the_same_when_chunks_close_by_the_clock(record):
    by_robot_time, by_clock = record("a.mcap"), record("b.mcap", reproducible=False)
    one, other = Recording.open(by_robot_time), Recording.open(by_clock)
    assert all(one.digest()[topic] == other.digest()[topic] for topic in one.topics)
    assert "clock" in other.metadata and "clock" not in one.metadata


class PlainWriter(Writer):
    """The library's own writer."""

    def __init__(self, stream):
        super().__init__(stream, 1 << 62, CompressionType.ZSTD)
        self.stream, self.channels = stream, {}

    def register_channel(self, topic, *given):
        self.channels[topic] = super().register_channel(topic, *given)

    def add_chunk(self, messages):
        for topic, time_ns, data in messages:
            self.add_message(self.channels[topic], time_ns, data, time_ns)
        self.flush()


def test_quick_packing_gives_the_bytes_of_the_library(record, monkeypatch):
    quick = record("quick.mcap").read_bytes()
    monkeypatch.setattr(recorder, "QuickWriter", PlainWriter)
    assert record("slow.mcap").read_bytes() == quick
    assert CompressionType.ZSTD.name.lower().encode() in quick


@pytest.mark.parametrize(
    ("max_loss", "period_ns"), [(1.0, 40_000_000), (0.1, 40_000_000), (1, 9**9)]
)
def test_queue_and_open_chunk_hold_at_most_what_may_be_lost(max_loss, period_ns):
    chunk, limit = bounds(max_loss, period_ns)
    assert chunk >= 1 and limit * period_ns <= max_loss * 1e9
    waiting = limit - chunk  # while a chunk is written
    assert waiting == 1 or 0 < waiting * period_ns <= 0.25e9


def test_loss_of_less_than_two_periods_is_refused():
    with pytest.raises(ValueError, match=r"at least 0.08"):
        bounds(0.05, 40_000_000)


def test_chunk_lasts_no_longer_than_it_may(record):
    for chunk in Recording.open(record(steps=100)).chunks():
        times = [message.time_ns for message in chunk if message.topic == "/joint_states"]
        assert max(times) - min(times) + made_up.PERIOD_NS <= 0.76e9


def test_run_that_fails_is_sealed(tmp_path):
    path = tmp_path / "run.mcap"
    with pytest.raises(ZeroDivisionError), made_up.recorder(path) as recorder:
        for sample, truths in made_up.run(30):
            recorder.write(sample, truths)
        _ = 1 / 0
    recording = Recording.open(path)
    assert recording.whole and len(list(recording.messages("/joint_states"))) == 30


def test_closing_twice_is_harmless(tmp_path):
    recorder = made_up.recorder(tmp_path / "run.mcap")
    recorder.close()
    recorder.close()
    assert Recording.open(tmp_path / "run.mcap").whole


def test_file_that_exists_is_not_overwritten(record):
    path = record()
    with pytest.raises(RecorderError, match=r"run.mcap cannot be written: File exists"):
        made_up.recorder(path)


def test_full_disk_is_told_in_the_loop_and_leaves_a_readable_file(tmp_path):
    path = tmp_path / "run.mcap"
    steps = made_up.run(10_000)
    told = pytest.raises(RecorderError, match=r"run.mcap cannot be written: File too large")
    with files_up_to(60_000), told, made_up.recorder(path) as recorder:
        for sample, truths in steps:
            recorder.write(sample, truths)
    assert next(steps)[0].seen.time_ns < 10_000 * made_up.PERIOD_NS  # told long before the end
    recording = Recording.open(path)
    assert not recording.whole and any(recording.messages("/joint_states"))


@pytest.mark.parametrize("death", [ZeroDivisionError("by zero"), SystemExit(1)])
def test_writer_thread_that_dies_is_told_in_the_loop(tmp_path, monkeypatch, death):
    real = mcap_file.McapFile.add_chunk

    def dies(self, messages, jpeg):
        if messages[0].time_ns > 1e9:
            raise death
        real(self, messages, jpeg)

    monkeypatch.setattr(mcap_file.McapFile, "add_chunk", dies)
    told = pytest.raises(RecorderError, match=r"run.mcap cannot be written")
    with told, made_up.recorder(tmp_path / "run.mcap") as recorder:
        for sample, truths in made_up.run(1000):
            recorder.write(sample, truths)
    recording = Recording.open(tmp_path / "run.mcap")
    assert not recording.whole and any(recording.messages("/joint_states"))


def test_disk_slower_than_the_robot_is_told_in_the_loop(tmp_path, monkeypatch):
    real = mcap_file.McapFile.add_chunk

    def slow(self, messages, jpeg):
        time.sleep(0.2)
        real(self, messages, jpeg)

    monkeypatch.setattr(mcap_file.McapFile, "add_chunk", slow)
    told = pytest.raises(RecorderError, match="cannot keep up")
    with told, made_up.recorder(tmp_path / "run.mcap", patience=0.04) as recorder:
        for sample, truths in made_up.run(100):
            recorder.write(sample, truths)
    assert Recording.open(tmp_path / "run.mcap").whole


def killed(tmp_path: Path, after: float, reproducible: bool, pause: float) -> tuple[int, Recording]:
    """Last step handed to a recorder that was killed `after` some steps, and what is left."""
    path = tmp_path / "run.mcap"
    code = KILLED.format(
        tests=str(Path(__file__).parent), path=str(path), reproducible=reproducible, pause=pause
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    process.stdout.readline()
    time.sleep(after)
    process.kill()
    last = process.stdout.read().split()
    process.wait()
    return int(last[-1]), Recording.open(path)


def lost_ns(last_ns: int, recording: Recording) -> int:
    written = [time_ns for time_ns, _ in recording.messages("/joint_command/sent")]
    return last_ns - max(written, default=0)


@pytest.mark.parametrize("after", [0.4, 0.73])
def test_killed_run_loses_at_most_a_second(tmp_path, after):
    last_ns, recording = killed(tmp_path, after, reproducible=True, pause=0.0)
    assert lost_ns(last_ns, recording) <= 1_000_000_000
    assert not recording.whole and recording.metadata["run"]["command"] == "reach"
    assert recording.attachments["config.yaml"] == b"seed: 0\n"


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("reproducible", [True, False])
def test_killed_run_loses_at_most_a_second_whenever_it_happens(tmp_path, seed, reproducible):
    after = np.random.default_rng(seed).uniform(1.0, 3.0)
    last_ns, recording = killed(tmp_path, after, reproducible, pause=0.002)
    assert lost_ns(last_ns, recording) <= 1_000_000_000


def test_recorder_needs_no_truth(tmp_path):
    path = tmp_path / "run.mcap"
    with made_up.recorder(path) as recorder:
        for sample, _ in made_up.run(5):
            recorder.write(sample, [])
    assert isinstance(recorder, Recorder)
    assert "/truth/hand" not in Recording.open(path).topics


def test_jpeg_of_a_real_camera_is_recorded_as_it_came(tmp_path):
    path, jpeg = tmp_path / "run.mcap", b"\xff\xd8 as it came"
    with made_up.recorder(path) as recorder:
        for sample, _ in made_up.run(3):
            seen = dataclasses.replace(sample.seen, jpeg=jpeg)
            recorder.write(dataclasses.replace(sample, seen=seen), [])
    recording = Recording.open(path)
    assert recording.topics["/camera/image"].type == "sensor_msgs/msg/CompressedImage"
    (_, image), *_ = recording.messages("/camera/image")
    assert (image.format, image.data.tobytes()) == ("jpeg", jpeg)


def test_slow_run_is_saved_once_a_second_unless_reproducible(tmp_path, monkeypatch):
    monkeypatch.setattr("imitation.recording.recorder.WALL_LIMIT", 0.05)
    with made_up.recorder(tmp_path / "run.mcap", reproducible=False) as recorder:
        for sample, truths in made_up.run(2):
            recorder.write(sample, truths)
        time.sleep(0.5)
        recording = Recording.open(tmp_path / "run.mcap")
        assert len(list(recording.messages("/joint_states"))) == 2
