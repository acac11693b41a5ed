"""Commands on the twin: robot=katana runs here exactly what it runs in the lab."""

import json
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from inspect import signature
from pathlib import Path

import numpy as np
import pytest
from omegaconf import OmegaConf

from cli.build import Bench
from cli.experiments import composed
from imitation.recording.mcap_recording import Recording
from imitation.robots.bodies import ideal_arm

PROGRAM = [sys.executable, "-c", "from cli.main import main; main()"]
STEADY = ("robot.approach.share=1", "--yes")
SWIFT = (*STEADY, "robot.arm.speed=[1.5,1.0,1.0,1.5,1.5]")
TWINS = {  # how each twin is started
    "400": (),
    "450": ("--model", "450"),
    "300": ("--model", "300", "--arm-pty", "arm"),
    "so101": ("robot=so101", "--arm-pty", "arm"),
}


@contextmanager
def twin(folder: Path, *words: str) -> Iterator[list[str]]:
    """The words that lead a command to a twin while it runs."""
    pty = folder / "neck"
    call = [*PROGRAM, "twin", "--port", "0", "--stream", "0", "--pty", str(pty), *words]
    with subprocess.Popen(call, stdout=subprocess.PIPE, text=True, cwd=folder) as process:
        try:
            process.stdout.readline()
            yield process.stdout.readline().split()[2:]
        finally:
            process.terminate()
            process.wait(timeout=20)


def imitate(folder: Path, *words: str) -> subprocess.CompletedProcess:
    call = [*PROGRAM, *words]
    return subprocess.run(
        call, cwd=folder, capture_output=True, text=True, timeout=300, stdin=subprocess.DEVNULL
    )


def events(folder: Path) -> dict[str, str]:
    """What happened, by its kind, in a recording that is whole."""
    recording = Recording.open(folder / "run.mcap")
    assert recording.digest() == recording.recomputed_digest()
    return {message.name: message.msg for _, message in recording.messages("/events")}


def true_distances(folder: Path, robot: str) -> list[float]:
    """Largest distance of the mark from the target in each hold of a reach run [px].

    A twin's arm stands where its emulated joints say.
    """
    cfg = composed("learn-map", f"robot={robot}")
    node, space = cfg["robot"]["arm"], Bench(cfg).learning_space
    arm = ideal_arm(**{key: node[key] for key in signature(ideal_arm).parameters})
    recording = Recording.open(folder / "run.mcap")
    target, since, held = np.zeros(2), 0, list[tuple[np.ndarray, int, int]]()
    for time_ns, event in recording.messages("/events"):
        if event.name == "episode":
            target = np.array(json.loads(event.msg[event.msg.index("{") :])["target_px"])
        since = time_ns if event.name == "settled" else since
        held += [(target, since, time_ns)] if event.name == "held" else []
    away = [0.0 for _ in held]
    for time_ns, joints in recording.messages("/joint_states"):
        for number, (target, first, last) in enumerate(held):
            if first <= time_ns <= last:
                arm.reset(np.array(joints.position))
                seen = space.project(arm.truth()[0], np.array(cfg["camera"]["eye"]))
                away[number] = max(away[number], float(np.linalg.norm(seen - target)))
    return away


def grips(folder: Path) -> list[dict]:
    """What the hand did in a replay."""
    messages = Recording.open(folder / "run.mcap").messages("/events")
    return [json.loads(one.msg[one.msg.index("{") :]) for _, one in messages if one.name == "grip"]


def test_a_real_arm_moves_only_when_somebody_says_so(tmp_path):
    with twin(tmp_path) as there:
        asked = imitate(tmp_path, "learn-map", *there, "out=asked")
        dry = imitate(tmp_path, "learn-map", *there, "out=dry", "learning.limit=1", "--dry-run")
    assert asked.returncode == 2
    assert "--yes" in asked.stderr
    assert "is about to move" in asked.stderr
    assert not (tmp_path / "asked").exists()
    assert dry.returncode == 1, dry.stderr  # nothing is learned of a hand that does not move
    assert json.loads((tmp_path / "dry" / "metrics.json").read_text())["steps"] > 3


def test_an_so101_behind_its_bus_begins_to_learn(tmp_path):
    with twin(tmp_path, *TWINS["so101"]) as there:
        run = imitate(tmp_path, "learn-map", *there, *SWIFT, "learning.limit=4", "out=run")
    assert run.returncode == 1, run.stderr  # so little time is not enough for all areas
    assert "learned" in events(tmp_path / "run")


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.parametrize("kind", TWINS)
def test_a_map_learned_through_the_wire_reaches(kind, tmp_path):
    pace = STEADY if kind == "300" else SWIFT
    with twin(tmp_path, *TWINS[kind]) as there:
        imitate(tmp_path, "learn-map", *there, *pace, "out=map")
        learned = json.loads((tmp_path / "map" / "metrics.json").read_text())
        assert learned["areas_learned"] >= 14
        reached = imitate(tmp_path, "reach", "map=map", "trials=6", *there, *pace, "out=reach")
    assert reached.returncode == 0, reached.stderr
    metrics = json.loads((tmp_path / "reach" / "metrics.json").read_text())
    assert all(trial["final_distance_px"] < 3 for trial in metrics["trials"])
    simulated, near = ("so101_sim", 3.5) if kind == "so101" else ("katana_sim", 3)
    away = true_distances(tmp_path / "reach", simulated)
    assert len(away) == 6
    assert sorted(away)[-2] < 3
    assert 0 < max(away) < near
    assert metrics["late_ticks"] < 0.05 * metrics["steps"]


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.parametrize("kind", ["400", "so101"])
def test_a_hand_before_the_twin_is_mimicked_and_its_action_learned_and_replayed(kind, tmp_path):
    kinds, alone = TWINS[kind], ("object=null",) if kind == "so101" else ()
    with twin(tmp_path, *kinds) as there:
        imitate(tmp_path, "learn-map", *there, *SWIFT, "out=map")
    with twin(tmp_path, *kinds, "--watching", "mimic", "demonstrator=circle") as there:
        words = ("map=map", "duration=30", "out=mimic")
        run = imitate(tmp_path, "mimic", *words, *there, *SWIFT)
        assert run.returncode == 0, run.stderr
    metrics = json.loads((tmp_path / "mimic" / "metrics.json").read_text())
    assert metrics["follow_rate"] > 0.6
    with twin(tmp_path, *kinds, "demonstrator=pick_and_place", *alone) as there:
        run = imitate(tmp_path, "demo-record", *there, *SWIFT, *alone, "out=action")
        assert run.returncode == 0, run.stderr
    metrics = json.loads((tmp_path / "action" / "metrics.json").read_text())
    assert metrics["states"] >= 3
    with twin(tmp_path, *kinds, "--watching", "replay", "demonstrator=trigger", *alone) as there:
        words = ("map=map", "action=action", "out=replay", *alone)
        run = imitate(tmp_path, "replay", *words, *there, *SWIFT)
        assert run.returncode == 0, run.stderr
    metrics = json.loads((tmp_path / "replay" / "metrics.json").read_text())
    assert metrics["order_correct"]
    assert metrics["own_from"] == "map read at the posture"
    closed = "closed on nothing" if alone else "holding"
    assert closed in {one["hand"] for one in grips(tmp_path / "replay")}


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_an_arm_with_long_control_periods_watches_as_well(tmp_path):
    words = ("--watching", "demo-record", "demonstrator=pick_and_place")
    with twin(tmp_path, *TWINS["300"], *words) as there:
        run = imitate(tmp_path, "demo-record", *there, *STEADY, "out=action")
    assert run.returncode == 0, run.stderr
    told = json.loads((tmp_path / "action" / "action.json").read_text())["states"]
    assert [one["area"] for one in told] == [[2, 0], [2, 2], [1, 3], [2, 4]]


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ("crashed_motor=2@14", "motor 2 has collided|collision"),
        ("stuck_motor=1@14", "motor 1 .* does not move"),
        ("stuck_encoder=1@14", "motor 1 .* does not move"),
        ("stuck_servo=1@9", "shoulder_pan .* does not move"),
        ("hot_servo=2@9", "servo 2 .* temperature"),
        ("overloaded_servo=3@9", "servo 3 .* overload"),
        ("silence@9", "the servos .* do not answer"),
        ("silence@14", "in vain|no reply"),
        ("wrong_crc@14", "wrong CRC"),
        ("cut@14", "is cut"),
        ("error_flag@14", "refuses"),
        ("neck_silence@12", "neck .* is silent"),
        ("neck_reset@12", "started anew"),
        ("camera_gone@14", "delivered no frame"),
    ],
)
def test_a_device_that_fails_ends_the_run_with_a_readable_recording(fault, told, tmp_path):
    kind = "so101" if "servo" in fault or "the servos" in told else "400"
    with twin(tmp_path, *TWINS[kind], "--fault", fault) as there:
        run = imitate(tmp_path, "learn-map", *there, *SWIFT, "learning.limit=25", "out=run")
    assert run.returncode == 3, run.stderr
    last = run.stderr.strip().splitlines()[-1]
    assert re.search(told, last)
    assert re.search(told, events(tmp_path / "run")["device"])
    assert json.loads((tmp_path / "run" / "metrics.json").read_text())["status"] == "failed"


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.parametrize(
    ("fault", "why"),
    [("camera_gone@12-13", "stale vision"), ("camera_frozen@12-16", "frozen vision")],
)
def test_while_the_camera_fails_the_arm_rests_and_then_goes_on(fault, why, tmp_path):
    with twin(tmp_path, "--fault", fault) as there:
        run = imitate(tmp_path, "learn-map", *there, *SWIFT, "learning.limit=25", "out=run")
    assert run.returncode in (0, 1), run.stderr
    recording = Recording.open(tmp_path / "run" / "run.mcap")
    told = [one.msg for _, one in recording.messages("/events") if one.name == "limited"]
    first = next(number for number, text in enumerate(told) if why in text)
    assert any(why not in text for text in told[first + 1 :])


def ended_by(folder: Path, number: int, words: list[str], once: str) -> tuple[int, float]:
    """Exit code of a run that is sent a signal once it says something, and how long it took [s]."""
    call = [*PROGRAM, "learn-map", *words, "out=run"]
    with subprocess.Popen(call, stderr=subprocess.PIPE, text=True, cwd=folder) as process:
        for line in process.stderr:
            if once in line:
                break
        time.sleep(1.0)
        process.send_signal(number)
        began = time.monotonic()
        process.communicate(timeout=30)
        return process.returncode, time.monotonic() - began


def joints(folder: Path, there: list[str]) -> dict[str, str]:
    """What the doctor tells of the devices, when the arm is at rest."""
    first, second = (imitate(folder, "doctor", *there, "--json").stdout for _ in range(2))
    told = [{one["subject"]: one["told"] for one in json.loads(text)} for text in (first, second)]
    assert told[0]["joints"] == told[1]["joints"]
    return told[1]


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("kind", ["400", "so101"])
def test_a_run_that_is_ended_freezes_the_arm_and_leaves_its_recording(kind, number, tmp_path):
    with twin(tmp_path, *TWINS[kind]) as there:
        code, _ = ended_by(tmp_path, number, [*there, *SWIFT], "s of robot time")
        assert code == 130
        told = joints(tmp_path, there)
    if kind == "400":
        assert told["motors"].startswith("status 8 8 8 8 8 8")
    else:
        assert "torque on" in told["servos"]
    assert json.loads((tmp_path / "run" / "metrics.json").read_text())["status"] == "interrupted"
    assert events(tmp_path / "run")


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.parametrize("kind", ["400", "so101"])
def test_an_arm_on_its_way_to_the_start_is_stopped_at_once(kind, tmp_path):
    slowly = ("robot.approach.share=0.05", "--yes")
    with twin(tmp_path, *TWINS[kind]) as there:
        code, took = ended_by(tmp_path, signal.SIGINT, [*there, *slowly], "about to move")
        assert code == 130
        assert took < 5.0
        joints(tmp_path, there)


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.parametrize("kind", ["400", "so101"])
def test_an_arm_parks_when_it_is_asked_to(kind, tmp_path):
    words = ("robot.approach.park=true", "learning.limit=2")
    with twin(tmp_path, *TWINS[kind]) as there:
        run = imitate(tmp_path, "learn-map", *there, *SWIFT, *words, "out=run")
        assert run.returncode == 1, run.stderr  # so little time is not enough for all areas
        told = joints(tmp_path, there)["joints"]
    angles = [float(one) for one in re.findall(r"(-?\d+)° \(", told)]
    rest = OmegaConf.load(tmp_path / "run" / "config.yaml").robot.rest
    assert angles == pytest.approx(np.degrees(rest), abs=3.0)
