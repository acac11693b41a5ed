"""imitate mimic: what it writes, and what it says."""

import json

import pytest


def told(folder) -> dict:
    return json.loads((folder / "metrics.json").read_text())


def test_it_follows_and_says_how_well(imitate, learned):
    words = ("robot=ideal", "demonstrator.period=8", "duration=10", "selection=soft", "out=run")
    result = imitate("mimic", f"map={learned}", *words)
    assert result.exit_code == 0, result.output
    metrics = told(imitate.folder / "run")
    assert metrics["status"] == "done"
    assert metrics["path_rmse_px"] < 6 < metrics["floor_rmse_px"]
    assert 0 <= metrics["lag_s"] <= 0.3
    assert metrics["correlation"] > 0.95
    assert metrics["follow_rate"] > 0.9
    assert metrics["areas_demonstrated"][0] == [2, 2]
    assert (metrics["demonstrated_from"], metrics["own_from"]) == ("demonstrator", "truth")
    assert imitate("verify", "run").exit_code == 0


def test_a_follow_rate_below_what_was_asked_is_exit_code_1(imitate, learned):
    hurried = ("demonstrator.period=2", "duration=5", "mimic.required=0.95")
    result = imitate("mimic", f"map={learned}", "robot=ideal", *hurried)
    assert result.exit_code == 1
    assert "mimic.required" in result.stderr


def test_a_hand_that_is_not_recognised_is_exit_code_1(imitate, learned):
    words = ("robot=ideal", "demonstrator.hand=skin", "duration=2", "out=run")
    result = imitate("mimic", f"map={learned}", *words)
    assert result.exit_code == 1
    assert "vision=" in result.stderr


def test_with_nobody_there_nothing_was_asked(imitate, learned):
    words = ("robot=ideal", "demonstrator=none", "duration=2", "out=run")
    result = imitate("mimic", f"map={learned}", *words)
    assert result.exit_code == 0
    metrics = told(imitate.folder / "run")
    assert metrics["follow_rate"] is metrics["correlation"] is metrics["lag_s"] is None


@pytest.mark.parametrize("word", ["duration=0", "selection=hard", "shift=[1]", "mimic.near=-1"])
def test_nonsense_is_refused(imitate, learned, word):
    result = imitate("mimic", f"map={learned}", "robot=ideal", word)
    assert result.exit_code == 2
    assert len(result.stderr.strip().splitlines()) == 1


def test_the_controls_show_what_makes_the_imitation(imitate, learned):
    few = ("controls.permutations=6", "controls.batch=6", "demonstrator.period=6", "duration=8")
    words = ("robot=ideal", "experiment=mimicry_controls", *few, "out=run")
    result = imitate("mimic", f"map={learned}", *words)
    assert result.exit_code == 0, result.output
    found = told(imitate.folder / "run")["controls"]
    assert len(found["shuffled_correlation"]) == 6
    assert found["shuffled_quantile"] < told(imitate.folder / "run")["correlation"]
    assert found["travelled_px"]["hand shown"] > 30
    for name in ("no hand shown", "self and other told apart"):
        assert found["travelled_px"][name] < 3
        assert name in result.stdout
    assert (imitate.folder / "run/run.mcap").is_file()


def test_a_control_that_does_not_come_out_is_exit_code_1(imitate, learned):
    few = ("controls.permutations=1", "duration=4", "controls.look=tag")
    words = ("robot=ideal", "experiment=mimicry_controls", *few)
    result = imitate("mimic", f"map={learned}", *words)
    assert result.exit_code == 1
    assert "told apart" in result.stderr


def test_before_the_mirror_the_arm_corrects_to_the_other_side(imitate, learned):
    words = ("robot=ideal", "experiment=mirror", "mirror.deviations=[0,5,20]", "out=run")
    result = imitate("mimic", f"map={learned}", *words)
    assert result.exit_code == 0, result.output
    straight, little, much = told(imitate.folder / "run")["mirror"]
    assert abs(straight["drawn_px"]) < 3
    assert much["drawn_px"] < little["drawn_px"] < -1
    assert much["followed_px"] > little["followed_px"] > 1
    assert imitate("verify", "run").exit_code == 0


@pytest.mark.parametrize("words", [("mirror", "circle"), ("mimicry_controls", "none")])
def test_an_experiment_without_its_demonstrator_is_refused(imitate, learned, words):
    experiment, shown = words
    given = (f"experiment={experiment}", f"demonstrator={shown}")
    result = imitate("mimic", f"map={learned}", "robot=ideal", *given)
    assert result.exit_code == 2
    assert "demonstrator" in result.stderr
