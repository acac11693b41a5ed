"""A sweep runs all its jobs, each in its folder, and ends with the worst exit code."""

import json

import pytest


def test_a_sweep_has_one_folder_a_job(imitate):
    words = ("robot=ideal", "learning.limit=0.2", "-m", "seed=0,1", "out=sweep")
    result = imitate("learn-map", *words)
    assert result.exit_code == 1, result.output  # so little time is not enough for all areas
    for job, seed in enumerate((0, 1)):
        metrics = json.loads((imitate.folder / f"sweep/{job}/metrics.json").read_text())
        assert metrics["seed"] == seed
    told = json.loads((imitate.folder / "sweep/sweep.json").read_text())
    assert [one["exit_code"] for one in told["jobs"]] == [1, 1]
    assert [path.name for path in imitate.folder.iterdir()] == ["sweep"]


def test_a_job_that_fails_does_not_stop_the_others_and_sets_the_exit_code(imitate):
    result = imitate("learn-map", "-m", "learning.limit=0.2,-1,120", "robot=ideal", "out=sweep")
    assert result.exit_code == 2
    assert "job 1: learning.limit=-1" in result.stderr
    told = json.loads((imitate.folder / "sweep/sweep.json").read_text())
    assert [one["exit_code"] for one in told["jobs"]] == [1, 2, 0]


def test_a_sweep_is_never_written_over(imitate):
    words = ["learn-map", "-m", "seed=0", "robot=ideal", "learning.limit=0.2", "out=sweep"]
    imitate(*words)
    result = imitate(*words)
    assert result.exit_code == 2
    assert "out=sweep-2" in result.stderr


@pytest.mark.slow
@pytest.mark.parametrize("launcher", ["joblib", "submitit_local"])
def test_a_launcher_runs_jobs_in_other_processes(imitate, launcher):
    words = ["robot=ideal", "-m", "learning.limit=0.2,120", f"hydra/launcher={launcher}"]
    result = imitate("learn-map", *words, "out=sweep")
    assert result.exit_code == 1, result.output
    told = json.loads((imitate.folder / "sweep/sweep.json").read_text())
    assert [one["exit_code"] for one in told["jobs"]] == [1, 0]


@pytest.mark.parametrize("word", ["hydra/launcher=submitit_slurm", "field=right_3x3,right_5x5"])
def test_a_sweep_that_cannot_begin_is_one_line_and_leaves_nothing(imitate, monkeypatch, word):
    monkeypatch.setenv("PATH", "")  # no Slurm
    result = imitate("learn-map", "-m", "robot=ideal", word, "out=sweep")
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1
    assert word.split(",")[-1] in result.stderr
    assert not list(imitate.folder.iterdir())
