"""Ctrl-C and SIGTERM end a run with its recording closed and readable."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from cli.metrics_file import PROMISED
from imitation.recording.mcap_recording import Recording

IMITATE = str(Path(sys.executable).parent / "imitate")


def started(folder, words):
    """`imitate` in a process of its own, once its run is well under way."""
    process = subprocess.Popen(
        [IMITATE, *words],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    deadline = time.monotonic() + 60
    while not any(path.stat().st_size > 50_000 for path in folder.rglob("run.mcap")):
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < deadline
        time.sleep(0.05)
    return process


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_leaves_a_whole_recording(tmp_path, learned, number):
    words = ["reach", "robot=ideal", f"map={learned}", "controller=noise", "trials=99", "out=run"]
    process = started(tmp_path, words)
    process.send_signal(number)
    found, told = process.communicate(timeout=30)
    assert process.returncode == 130
    assert told.splitlines()[-1] == "imitate: interrupted"
    assert found.splitlines()[-1] == "next   imitate inspect run"
    recording = Recording.open(tmp_path / "run")
    assert recording.whole
    assert recording.digest() == recording.recomputed_digest()
    metrics = json.loads((tmp_path / "run" / "metrics.json").read_text())
    assert metrics["status"] == "interrupted"
    assert set(PROMISED["reach"]) <= set(metrics)
    assert metrics["steps"] == sum(1 for _ in recording.messages("/joint_states"))


@pytest.mark.parametrize("launcher", ["basic", pytest.param("joblib", marks=pytest.mark.slow)])
def test_a_signal_ends_a_whole_sweep(tmp_path, learned, launcher):
    words = ["reach", "robot=ideal", f"map={learned}", "controller=noise", "trials=99", "out=sweep"]
    process = started(tmp_path, [*words, "-m", "seed=range(0,4)", f"hydra/launcher={launcher}"])
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    assert process.returncode == 130
    told = json.loads((tmp_path / "sweep" / "sweep.json").read_text())
    assert [one["exit_code"] for one in told["jobs"]] == [130] * 4
    begun = list((tmp_path / "sweep").glob("*/run.mcap"))
    assert begun
    assert all(Recording.open(path).whole for path in begun)
    assert not (tmp_path / "sweep" / "3").exists()


def signalled(number: signal.Signals, part: str, *typed: str) -> tuple[int, bytes, bytes]:
    """What becomes of `imitate TYPED` when a signal comes while it loads `part` of itself."""
    program = f"""
import os, sys
from cli.start import main

class Signalled:
    def find_spec(self, name, *more):
        if name == {part!r}:
            os.kill(os.getpid(), {int(number)})

sys.meta_path.insert(0, Signalled())
sys.exit(main())
"""
    call = [sys.executable, "-c", program, *typed]
    told = subprocess.run(call, capture_output=True, timeout=30)
    return told.returncode, told.stdout, told.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_while_the_program_is_loaded_ends_it_quietly(number):
    assert signalled(number, "typer") == (130, b"", b"")


def test_a_signal_while_a_part_that_the_configuration_names_is_loaded_is_no_error_of_it():
    part = "imitation.robots.faults"
    told = signalled(signal.SIGINT, part, "learn-map", "robot=ideal")
    assert told == (130, b"", b"imitate: interrupted\n")
