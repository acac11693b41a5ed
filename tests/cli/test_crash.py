"""A killed run loses a second at most and is made whole again; a full disk ends a run well."""

import errno
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from rosbags.highlevel import AnyReader
from small_disk import small_disk

from cli.experiments import composed
from imitation.recording.mcap_file import McapFile
from imitation.recording.mcap_recording import Recording
from imitation.robots.ideal import IdealArm

ZSTD = b"\x28\xb5\x2f\xfd"  # begins what a chunk holds
KILLS = 30  # of each stage
TELLING = """
from cli.run import Run
noted = Run._note
def note(self, sample):
    noted(self, sample)
    print(sample.seen.time_ns, flush=True)
Run._note = note
from cli.main import main
main()
"""
STAGES = {
    "learn-map": ["learn-map"],
    "reach": ["reach", "map={map}", "controller=noise", "trials=99"],
    "mimic": ["mimic", "map={map}", "duration=120"],
    "demo-record": ["demo-record", "demo.gone=60"],
    "replay": ["replay", "map={map}", "action={action}", "replay.after=60"],
}
LONGEST = {"learn-map": 250, "demo-record": 280}  # steps that a run has for certain


def killed(folder, words, after, robot="ideal"):
    """Time of the last step [ns] of a run killed when it has made `after` steps or a few more."""
    call = [sys.executable, "-c", TELLING, *words, f"robot={robot}", f"out={folder}"]
    process = subprocess.Popen(
        call, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, cwd=folder.parent
    )
    told = [process.stdout.readline() for _ in range(after)]
    process.kill()
    told += process.stdout.read().split()
    process.wait()
    return int(told[-1])


@pytest.fixture(scope="module")
def action(ran):
    """Folder of an action that was watched: not to be changed."""
    return ran("demo-record")


def check_recovered(imitate, run):
    """A recovered run is accepted by our programs and by others'."""
    recorded = Recording.open(run)
    assert recorded.whole
    for command in ("inspect", "verify"):
        told = imitate(command, str(run))
        assert told.exit_code == 0, told.output
        assert "None" not in told.output
    metrics = json.loads((run / "metrics.json").read_text())
    assert metrics["status"] == "truncated"
    with AnyReader([run / "run.mcap"]) as reader:
        topics = [connection.topic for connection, _, _ in reader.messages()]
    assert metrics["steps"] == topics.count("/joint_states")
    call = [sys.executable, "-m", "rerun_cli", "mcap", "check", "--full", str(run / "run.mcap")]
    assert subprocess.run(call, capture_output=True, check=False).returncode == 0


def check_a_kill(imitate, learned, action, run, stage, after, robot="ideal"):
    words = [word.format(map=learned, action=action) for word in STAGES[stage]]
    last_ns = killed(run, words, after, robot)
    cut = Recording.open(run)
    assert not cut.whole, "it had come to its end"
    written = [time_ns for time_ns, _ in cut.messages("/joint_command/sent")]
    assert last_ns - (written[-1] if written else -40_000_000) <= 1_000_000_000
    before = (run / "run.mcap").read_bytes()
    told = imitate("recover", str(run))
    assert told.exit_code == 0, told.output
    assert (run / "run.truncated.mcap").read_bytes() == before
    again = [time_ns for time_ns, _ in Recording.open(run).messages("/joint_command/sent")]
    assert again == written
    check_recovered(imitate, run)


@pytest.mark.parametrize("stage", ["mimic", "replay"])
def test_a_killed_run_is_recovered(imitate, learned, action, tmp_path, stage):
    check_a_kill(imitate, learned, action, tmp_path / "run", stage, after=60)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(KILLS))
@pytest.mark.parametrize("stage", STAGES)
def test_a_killed_run_is_recovered_whenever_it_happens(
    imitate, learned, action, tmp_path, stage, number
):
    after = int(np.random.default_rng(number).integers(1, LONGEST.get(stage, 400)))
    check_a_kill(imitate, learned, action, tmp_path / "run", stage, after)


@pytest.mark.slow
@pytest.mark.parametrize("stage", STAGES)
def test_a_killed_run_in_the_engine_is_recovered(imitate, learned, action, tmp_path, stage):
    check_a_kill(imitate, learned, action, tmp_path / "run", stage, 150, robot="katana_sim")


@pytest.mark.parametrize("share", [0.05, 0.8])
def test_a_run_cut_anywhere_is_recovered(imitate, learned, tmp_path, share):
    data = (learned / "run.mcap").read_bytes()
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "run.mcap").write_bytes(data[: int(share * len(data))])
    told = imitate("recover", "run")
    assert told.exit_code == 0, told.output
    check_recovered(imitate, tmp_path / "run")


@pytest.mark.parametrize("cut", [0, 100])
def test_damage_ends_what_is_recovered(imitate, learned, tmp_path, cut):
    whole = (learned / "run.mcap").read_bytes()
    data = bytearray(whole[: len(whole) - cut])
    data[data.index(ZSTD, len(data) // 2) + 50] ^= 0xFF
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "run.mcap").write_bytes(data)
    assert imitate("inspect", "run").exit_code == 2
    assert "damage" in imitate("recover", "run").stdout
    check_recovered(imitate, tmp_path / "run")


def test_what_is_no_run_of_ours_is_not_recovered(imitate, tmp_path):
    for data in (b"hello", b"\x89MCAP0\r\n" + bytes(100)):
        (tmp_path / "run.mcap").write_bytes(data)
        told = imitate("recover", "run.mcap")
        assert told.exit_code == 2 and "no recording" in told.stderr
        assert [path.name for path in tmp_path.iterdir()] == ["run.mcap"]


def test_a_whole_run_is_left_alone(imitate, learned):
    before = (learned / "run.mcap").read_bytes()
    told = imitate("recover", str(learned))
    assert told.exit_code == 0 and "nothing to recover" in told.stdout
    assert (learned / "run.mcap").read_bytes() == before


def test_a_run_that_goes_on_is_not_recovered(imitate, learned, tmp_path):
    words = ["reach", f"map={learned}", "controller=noise", "trials=99"]
    call = [sys.executable, "-c", TELLING, *words, "robot=ideal", f"out={tmp_path / 'run'}"]
    process = subprocess.Popen(call, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        for _ in range(50):
            process.stdout.readline()
        told = imitate("recover", "run")
        assert told.exit_code == 2 and "still being written" in told.stderr
    finally:
        process.kill()
        process.communicate()


def test_the_next_run_writes_nothing_over(imitate, learned, tmp_path):
    killed(tmp_path / "run", ["learn-map"], after=5)
    before = (tmp_path / "run" / "run.mcap").read_bytes()
    told = imitate("learn-map", "robot=ideal", "out=run")
    assert told.exit_code == 2 and "out=run-2" in told.stderr
    assert (tmp_path / "run" / "run.mcap").read_bytes() == before


def check_a_full_disk(result, run):
    assert result.returncode == 3
    (told,) = [line for line in result.stderr.splitlines() if " · " not in line]  # no progress
    assert "cannot be written" in told
    recording = Recording.open(run)
    assert not recording.whole
    assert sum(1 for _ in recording.messages("/joint_states")) > 20


def test_a_full_disk_ends_the_run(tmp_path):
    with small_disk(tmp_path / "disk", "300k") as disk:
        call = [sys.executable, "-c", TELLING, "learn-map", "robot=ideal", f"out={disk / 'run'}"]
        result = subprocess.run(call, capture_output=True, text=True, check=False)
        check_a_full_disk(result, disk / "run")


@pytest.mark.slow
def test_a_full_quota_ends_the_run(imitate, tmp_path):
    program = f"{sys.executable} -c '{TELLING}' learn-map robot=ideal out={tmp_path / 'run'}"
    call = ["bash", "-c", f"ulimit -f 100; exec {program}"]
    result = subprocess.run(call, capture_output=True, text=True, check=False)
    check_a_full_disk(result, tmp_path / "run")
    assert json.loads((tmp_path / "run" / "metrics.json").read_text())["status"] == "failed"
    assert imitate("recover", "run").exit_code == 0
    check_recovered(imitate, tmp_path / "run")


def test_a_recorder_that_fails_lets_the_arm_come_to_rest_first(imitate, monkeypatch):
    """The last that is sent is no movement, and every joint brakes as hard as it may, no harder."""
    sent, wrote = [], McapFile.add_chunk
    moved = IdealArm.move

    def full(self, messages, jpeg):
        if messages[0].time_ns > 1e9:
            raise OSError(errno.ENOSPC, "No space left on device")
        wrote(self, messages, jpeg)

    def move(self, velocity, grip, period):
        sent.append(velocity)
        return moved(self, velocity, grip, period)

    monkeypatch.setattr(McapFile, "add_chunk", full)
    monkeypatch.setattr(IdealArm, "move", move)
    told = imitate("learn-map", "robot=ideal", "out=run")
    assert told.exit_code == 3 and len(told.stderr.splitlines()) == 1, told.output
    assert not sent[-1].any() and sent[-2].any()
    braked = np.array(sent[-4:])
    hardest = composed("learn-map", "robot=ideal")["robot"]["arm"]["acceleration"]
    assert (np.abs(np.diff(braked, axis=0)) <= np.array(hardest) * 0.04 + 1e-9).all()
    assert any(Recording.open(Path("run")).messages("/joint_states"))
