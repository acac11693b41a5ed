"""What a run leaves behind, and that it is the same when repeated."""

import json
import shutil
import subprocess
import sys

import pytest
from omegaconf import OmegaConf

from cli.check import checked
from cli.jobs.reach import outcome
from imitation.recording.mcap_recording import Recording
from imitation.robots.bullet.world import find_urdf

FILES = {"run.mcap", "run.rrd", "metrics.json", "config.yaml", "log.txt", "map.npz"}


@pytest.fixture(scope="module")
def metrics(learned):
    return json.loads((learned / "metrics.json").read_text())


def test_a_run_folder_holds_what_the_contract_says(learned):
    assert {path.name for path in learned.iterdir()} == FILES


def test_metrics_tell_of_the_run(metrics):
    assert metrics["command"] == "learn-map"
    assert metrics["status"] == "done"
    assert metrics["seed"] == 0
    assert metrics["steps"] == pytest.approx(metrics["robot_time_s"] / 0.04, abs=1)
    assert metrics["wall_time_s"] > 0
    assert metrics["areas_learned"] == metrics["areas_total"] == 16
    assert metrics["coverage"] == 1.0


def test_the_configuration_can_be_loaded_again(learned):
    checked("learn-map", OmegaConf.load(learned / "config.yaml"))


def test_the_recording_tells_where_it_comes_from_but_no_paths(imitate, learned):
    imitate("reach", "robot=ideal", f"map={learned}", "out=here", "seed=3")
    recording = Recording.open(imitate.folder / "here")
    told = recording.metadata["run"]
    assert told["command"] == "reach"
    assert told["seed"] == "3"
    assert told["robot"] == "ideal"
    assert "numpy" in json.loads(told["packages"])
    attached = recording.attachments["config.yaml"].decode()
    assert "here" not in attached
    assert str(learned) not in attached
    assert "map: sha256:" in attached
    assert recording.attachments["map.npz"] == (learned / "map.npz").read_bytes()
    assert "katana_6m180.urdf" in recording.attachments


def test_where_and_under_which_name_an_input_lies_does_not_change_the_bytes(imitate, learned):
    for place in (imitate.folder / "one", imitate.folder / "two"):
        place.mkdir()
        shutil.copy(learned / "map.npz", place / f"{place.name}.npz")
        shutil.copy(find_urdf("katana_6m180.urdf"), place / "own.urdf")
        words = (f"map={place / place.name}.npz", f"robot.arm.urdf={place / 'own.urdf'}")
        imitate("reach", "robot=ideal", *words, f"out={place / 'run'}")
    one, two = (imitate.folder / name / "run" / "run.mcap" for name in ("one", "two"))
    assert one.read_bytes() == two.read_bytes()


@pytest.mark.parametrize("controller", ["yuragi", "corrected_aim"])
def test_the_same_seed_twice_gives_the_same_bytes(imitate, learned, controller):
    words = ["robot=ideal", f"map={learned}", f"controller={controller}", "reach.limit=3"]
    for out in ("one", "two"):
        imitate("reach", *words, "trials=2", f"out={out}", "reach.required=0")
    one, two = (imitate.folder / out / "run.mcap" for out in ("one", "two"))
    assert one.read_bytes() == two.read_bytes()


def test_another_seed_gives_another_recording(imitate, learned):
    for seed in (1, 2):
        imitate("reach", "robot=ideal", f"map={learned}", f"seed={seed}", f"out={seed}")
    one, two = (imitate.folder / str(seed) / "run.mcap" for seed in (1, 2))
    assert one.read_bytes() != two.read_bytes()


def test_runs_without_a_name_lie_side_by_side(imitate, learned):
    for _ in range(2):
        assert imitate("reach", "robot=ideal", f"map={learned}").exit_code == 0
    assert len(list((imitate.folder / "data/runs/reach").iterdir())) == 2


def test_hydra_leaves_nothing_behind(imitate):
    imitate("learn-map", "robot=ideal", "out=run", "learning.limit=0.2")
    assert [path.name for path in imitate.folder.iterdir()] == ["run"]


def test_a_success_rate_below_the_required_one_is_exit_code_1(imitate, learned):
    words = ["reach", "robot=ideal", f"map={learned}", "reach.limit=0.1"]
    result = imitate(*words)
    assert result.exit_code == 1
    assert "reach.required" in result.stderr
    assert imitate(*words, "reach.required=0").exit_code == 0
    assert imitate(*words, "controller=noise").exit_code == 0


def test_learning_that_comes_to_its_limit_is_exit_code_1(imitate):
    result = imitate("learn-map", "robot=ideal", "learning.limit=1")
    assert result.exit_code == 1
    assert "limit" in result.stderr


def test_the_end_of_a_run_names_results_files_and_the_next_command(imitate):
    out = imitate("learn-map", "robot=ideal", "out=a").stdout
    assert "16 of 16" in out
    assert "a/" in out
    assert "imitate reach map=a robot=ideal" in out


@pytest.mark.parametrize(("stops", "told"), [(True, "reach.after=hold holds"), (False, "0%")])
def test_an_arm_that_stopped_at_its_target_is_told_to_hold_by_a_key(stops, told):
    metrics = {"controller": "yuragi", "trials": [], "reached_rate": 1.0, "held_rate": 0.0}
    metrics |= {"success_rate": 1.0, "median_time_s": 2.0}
    held = dict(outcome(metrics, holding=False, stops=stops, wanted=1.0).rows)["held"]
    assert held.endswith(told)


def test_a_folder_may_have_any_name(imitate):
    name = "it's x=1,2 b"
    assert imitate("learn-map", "robot=ideal", f"out={name}").exit_code == 0
    assert (imitate.folder / name / "map.npz").is_file()
    assert imitate("reach", "robot=ideal", f"map={name}").exit_code == 0


def test_a_recording_that_cannot_be_written_is_exit_code_3(tmp_path):
    program = "from cli.main import main; main()"
    limit = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000)); "
    call = [sys.executable, "-c", limit + program, "learn-map", "robot=ideal", "out=run"]
    told = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert told.returncode == 3
    assert told.stderr.count("\n") == 1
    assert "run.mcap cannot be written" in told.stderr
    metrics = json.loads((tmp_path / "run" / "metrics.json").read_text())
    assert metrics["status"] == "failed"


def test_a_refused_run_leaves_no_folder_behind(imitate):
    assert imitate("reach", "robot=ideal", "map=nowhere", "out=here").exit_code == 2
    assert not (imitate.folder / "here").exists()


def test_a_refused_run_takes_nothing_away_that_is_not_its_own(imitate):
    (imitate.folder / "here").mkdir()
    (imitate.folder / "here" / "notes.txt").write_text("mine")
    assert imitate("reach", "robot=ideal", "map=nowhere", "out=here").exit_code == 2
    assert [path.name for path in (imitate.folder / "here").iterdir()] == ["notes.txt"]


def test_no_screenshot_is_written_over(imitate, learned):
    (imitate.folder / "here.png").write_bytes(b"another")
    told = imitate("view", str(learned), "--screenshot", "here.png")
    assert told.exit_code == 2 and "--screenshot here-2.png" in told.stderr
    assert (imitate.folder / "here.png").read_bytes() == b"another"
