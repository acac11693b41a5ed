"""`imitate demo-record`, as a user types it."""

import json
import shlex
from pathlib import Path

import pytest
from typer.testing import CliRunner

from cli.main import app
from imitation.recording.action_file import load_action
from imitation.recording.mcap_recording import Recording
from imitation.recording.overview import Overview
from imitation.recording.rerun_view.panels import fields


@pytest.fixture(scope="module")
def recorded(tmp_path_factory) -> Path:
    """Folder of a finished demo-record run: not to be changed."""
    folder = tmp_path_factory.mktemp("recorded") / "action"
    result = CliRunner().invoke(app, ["demo-record", "robot=ideal", f"out={folder}"])
    assert result.exit_code == 0, result.output
    (folder / "stdout").write_text(result.stdout)
    return folder


def test_the_action_is_saved_and_loads(recorded):
    action = load_action(recorded, shortest=0.2, longest=20.0)
    assert [state.area for state in action.states] == [(2, 0), (2, 2), (1, 3), (2, 4)]


def test_metrics_tell_states_and_delays(recorded):
    metrics = json.loads((recorded / "metrics.json").read_text())
    told = json.loads((recorded / "action.json").read_text())
    assert metrics["states"] == 4
    assert metrics["delays_s"] == pytest.approx([one["delay_s"] for one in told["states"][1:]])
    assert max(map(abs, metrics["clock_error_s"])) <= 0.04


def test_the_recording_holds_an_event_for_each_state(recorded):
    log = Recording.open(recorded).messages("/events")
    assert [event.name for _, event in log].count("state") == 4


def test_it_names_the_states_and_the_command_to_type_next(recorded):
    out = (recorded / "stdout").read_text()
    assert "area [2, 2]" in out
    learn = "imitate learn-map out=data/runs/map robot=ideal"
    assert f"{learn} && imitate replay map=data/runs/map action={recorded} robot=ideal" in out


def test_what_it_says_to_type_next_can_be_typed(imitate):
    words = ("robot=ideal", "camera.noise_px=0.2", "'vision.hue=[169,11]'")
    result = imitate("demo-record", *(word.strip("'") for word in words))
    [said] = [line for line in result.stdout.splitlines() if line.startswith("next")]
    for command in said.removeprefix("next").split("&&"):
        program, *typed = shlex.split(command)
        assert program == "imitate"
        assert imitate(*typed).exit_code == 0, command
    assert words[-1] in said
    again = imitate("demo-record", "robot=ideal").stdout
    assert "next   imitate replay map=data/runs/map action=data/runs/demo-record/" in again


def test_an_arm_with_long_control_periods_learns_the_same_states(imitate):
    assert imitate("demo-record", "robot=ideal", "period=0.36", "out=slow").exit_code == 0
    told = json.loads((imitate.folder / "slow" / "action.json").read_text())
    assert len(told["states"]) == 4


def test_without_a_demonstration_the_exit_code_is_1_and_there_is_no_action(imitate):
    result = imitate(
        "demo-record", "robot=ideal", "demonstrator=none", "demo.duration=1", "out=run"
    )
    assert result.exit_code == 1
    assert result.stderr.count("\n") == 1
    assert "no hand was seen to rest" in result.stderr
    assert not (imitate.folder / "run" / "action.json").exists()


def test_one_state_is_no_action(imitate):
    result = imitate("demo-record", "robot=ideal", "demonstrator=trigger", "demo.duration=3")
    assert result.exit_code == 1
    assert "area [2, 0] alone" in result.stderr


def test_an_action_that_cannot_be_played_is_saved_all_the_same(imitate):
    result = imitate("demo-record", "robot=ideal", "sequence.cells.longest=3", "out=run")
    assert result.exit_code == 1
    assert "sequence.cells.longest=" in result.stderr
    assert (imitate.folder / "run" / "action.json").is_file()


def test_the_same_seed_gives_the_same_bytes(imitate):
    for out in ("one", "two"):
        imitate("demo-record", "robot=ideal", "demo.duration=3", f"out={out}")
    one, two = (imitate.folder / out / "run.mcap" for out in ("one", "two"))
    assert one.read_bytes() == two.read_bytes()


def test_the_view_of_a_robot_that_only_watched_has_nothing_empty(recorded):
    shown = Overview.of(Recording.open(recorded))
    assert shown.curves == {"joints", "places"}
    assert set(fields(shown)) == {"/visual_input"}


@pytest.mark.parametrize("broken", [b"robot: [", b"7", b"robot: {}", b"\xff\xfe", None])
def test_a_broken_run_beside_does_no_harm(imitate, recorded, broken):
    """What is typed next is looked for among all maps, whatever lies there."""
    beside = imitate.folder / "data" / "runs" / "learn-map" / "old"
    beside.mkdir(parents=True)
    (beside / "map.npz").touch()
    if broken is None:
        (beside / "map.npz").unlink()
        (beside / "map.npz").symlink_to("nowhere")
    else:
        (beside / "config.yaml").write_bytes(broken)
    result = imitate("inspect", str(recorded))
    assert result.exit_code == 0 and "imitate learn-map out=data/runs/map" in result.stdout
