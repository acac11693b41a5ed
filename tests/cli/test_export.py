"""Recordings leave as tables, films and LeRobot datasets, whole or not at all."""

import csv
import json
import subprocess
from collections import defaultdict

import cv2
import numpy as np
import pyarrow.parquet as pq
import pytest
import rerun as rr
from tampering import rewrite

import cli.export
from imitation.recording.mcap_recording import Recording
from imitation.recording.recorded_steps import steps_told


@pytest.fixture(scope="module")
def run(ran, learned):
    """Two short reaches: not to be changed."""
    words = ["reach.limit=0.6", "reach.required=0", "trials=2", "controller=yuragi"]
    return ran("reach", *words, f"map={learned}")


@pytest.fixture(scope="module")
def steps(run):
    return list(steps_told(Recording.open(run)))


def test_a_table_has_a_row_a_step_and_units(imitate, run, steps, tmp_path):
    assert imitate("export", str(run), "--to", "parquet", "run.parquet").exit_code == 0
    table = pq.read_table(tmp_path / "run.parquet")
    assert table.num_rows == len(steps)
    units = {field.name: field.metadata[b"unit"].decode() for field in table.schema}
    joint = Recording.open(run).topics["/joint_states"].names[1]
    assert units["time"] == "s" and units["hand.x"] == "px"
    assert units[f"joint_states.{joint}_position"] == "rad"
    assert units[f"joint_command.sent.{joint}_velocity"] == "rad/s"
    rows = table.to_pydict()
    assert rows["time"] == [step.time_ns / 1e9 for step in steps]
    postures = [step.step.seen.posture[1] for step in steps]
    assert rows[f"joint_states.{joint}_position"] == postures
    assert rows["episode"] == [0] * 16 + [1] * 16
    assert all(len(one) == 3 for index in rows["attractors.index"] for one in index)


def test_csv_tells_the_same_as_parquet(imitate, run, tmp_path):
    imitate("export", str(run), str(run), "--to", "parquet", "run.parquet")
    imitate("export", str(run), str(run), "--to", "csv", "run.csv")
    table = pq.read_table(tmp_path / "run.parquet")
    with (tmp_path / "run.csv").open(newline="") as file:
        head, *rows = csv.reader(file)
    assert [name.partition(" [")[0] for name in head] == table.column_names
    assert "hand.x [px]" in head
    assert len(rows) == table.num_rows
    for at, name in enumerate(table.column_names):
        if name in ("time", "hand.y", "dynamics.gain"):
            assert [float(row[at]) for row in rows] == table[name].to_pylist()


def test_a_film_lasts_as_long_as_the_run(imitate, run, steps, tmp_path):
    assert imitate("export", str(run), "--to", "video", "run.mp4").exit_code == 0
    film = cv2.VideoCapture(str(tmp_path / "run.mp4"))
    pictures = []
    while (read := film.read())[0]:
        pictures.append(read[1])
    assert film.get(cv2.CAP_PROP_FPS) == pytest.approx(25)
    last = steps[-1].time_ns
    assert len(pictures) == last / 40_000_000 + 1
    assert pictures[0].shape == (480, 640, 3)


def test_a_dataset_tells_frames_state_and_what_was_sent(imitate, run, steps, tmp_path):
    assert imitate("export", str(run), str(run), "--to", "lerobot", "set").exit_code == 0
    info = json.loads((tmp_path / "set" / "meta" / "info.json").read_text())
    assert (info["codebase_version"], info["fps"]) == ("v3.0", 25)
    assert (info["total_episodes"], info["total_frames"]) == (4, 2 * len(steps))
    second = pq.read_table(tmp_path / "set" / info["data_path"].format(chunk_index=0, file_index=1))
    assert set(second.column_names) == set(info["features"])
    rows, mine = second.to_pydict(), steps[16:]
    assert rows["timestamp"] == pytest.approx([0.04 * n for n in range(16)])
    assert rows["index"] == list(range(16, 32))
    for row, step in zip(range(16), mine, strict=True):
        assert rows["observation.state"][row] == pytest.approx(step.step.seen.posture)
        assert rows["action"][row] == pytest.approx(step.step.sent)
        png = np.frombuffer(rows["observation.images.camera"][row]["bytes"], np.uint8)
        frame = cv2.imdecode(png, cv2.IMREAD_COLOR_RGB)
        assert np.array_equal(frame, step.step.seen.frame)
    stats = json.loads((tmp_path / "set" / "meta" / "stats.json").read_text())
    postures = np.array([step.step.seen.posture for step in steps])
    assert stats["observation.state"]["mean"] == pytest.approx(postures.mean(axis=0), abs=1e-6)
    assert np.shape(stats["observation.images.camera"]["std"]) == (3, 1, 1)


def test_rerun_opens_the_dataset(imitate, run, steps, tmp_path):
    imitate("export", str(run), "--to", "lerobot", "set")
    stream = rr.RecordingStream("dataset")
    stream.save(tmp_path / "set.rrd")
    stream.log_file_from_path(tmp_path / "set")
    stream.disconnect()
    reader = rr.chunk.RrdReader(tmp_path / "set.rrd")
    episodes = [one for one in reader.recordings() if one.recording_id.startswith("episode")]
    assert len(episodes) == 2
    rows = defaultdict(int)
    for episode in episodes:
        for chunk in reader.stream(store=episode).to_chunks():
            if not chunk.is_static:
                rows[str(chunk.entity_path)] += chunk.num_rows
    for entity in ("/observation.images.camera", "/observation.state", "/action"):
        assert rows[entity] == len(steps)


def test_a_dataset_is_of_one_robot(imitate, run, tmp_path):
    """The simulated Katana has the joints of the ideal arm, and is another robot all the same."""

    def tell(name, told):
        return told | {"robot": "katana_sim"} if name == "run" else told

    rewrite(run / "run.mcap", tmp_path / "other.mcap", tell=tell, sealed=True)
    result = imitate("export", str(run), "other.mcap", "--to", "lerobot", "set")
    assert result.exit_code == 2 and result.stderr.count("\n") == 1
    assert "a LeRobot dataset is of one robot" in result.stderr
    assert not (tmp_path / "set").exists()


def test_an_export_that_fails_leaves_nothing(imitate, run, tmp_path, monkeypatch):
    def fails(out, recordings):
        (out.mkdir() if out.suffix == "" else out.write_text("half"))
        raise KeyboardInterrupt

    for kind, out in (("csv", "run.csv"), ("lerobot", "set")):
        monkeypatch.setitem(cli.export.KINDS, kind, fails)
        assert imitate("export", str(run), "--to", kind, out).exit_code == 130
    assert list(tmp_path.iterdir()) == []


def test_what_a_killed_export_left_is_gone_after_the_next(imitate, run, tmp_path):
    """A kill leaves a hidden file, and nothing where the export was to be."""
    ended = subprocess.Popen(["true"])
    ended.wait()
    (tmp_path / f".set-{ended.pid}").mkdir()
    (tmp_path / f".set-{ended.pid}" / "half").touch()
    (tmp_path / ".set-1").mkdir()  # of an export that goes on
    (tmp_path / f".other-{ended.pid}").mkdir()
    assert imitate("export", str(run), "--to", "lerobot", "set").exit_code == 0
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {"set", ".set-1", f".other-{ended.pid}"}


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("{run}", "--to", "cvs", "a"), "did you mean csv"),
        (("{run}", "--to", "csv"), "a run and OUT are needed"),
        (("{run}", "--to", "csv", "{run}"), "nothing is written over"),
        (("{run}", "--to", "video", "a.avi"), "a.mp4"),
        (("nowhere", "--to", "csv", "a.csv"), "no recording at"),
        (("{run}", "{run}", "--to", "video", "a.mp4"), "one run"),
    ],
)
def test_a_bad_export_is_one_line(imitate, run, words, told):
    result = imitate("export", *(word.format(run=run) for word in words))
    assert result.exit_code == 2
    assert told in result.stderr and len(result.stderr.splitlines()) == 1
