"""What is said to type next can be typed: it finds the same arm and the same camera."""

import json
import shlex

import pytest
from made_up_films import film

from cli.build import Bench
from cli.experiments import composed
from cli.following import camera_words, reach_with, replay_of
from cli.jobs.demo_record import shows_the_arm

TYPED = ("--config-dir=my arms", "robot=mine", "camera.device=/dev/video0", "vision=skin")


def a_robot_of_ones_own(folder, name: str) -> None:
    path = folder / "my arms" / "robot" / "mine.yaml"
    path.parent.mkdir(parents=True)
    path.write_text(f"defaults: [{name}, _self_]\nname: mine\n")


def said_by(text: str) -> list[list[str]]:
    [line] = [one for one in text.splitlines() if one.startswith("next")]
    return [shlex.split(one)[1:] for one in line.removeprefix("next").split("&&")]


def test_a_map_for_a_replay_is_learned_with_the_camera_that_watched(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    learn, replay = replay_of("run", "mine", TYPED, camera_words(TYPED)).split(" && ")
    assert "camera.device=/dev/video0" in learn and "camera.device=/dev/video0" in replay
    assert "vision=skin" not in learn  # the hand that was watched need not look like the arm's own


@pytest.mark.parametrize("camera", [("video", "path"), ("webcam", "device")])
def test_a_film_and_a_live_camera_show_no_simulated_arm(tmp_path, camera):
    film(tmp_path / "film.mp4", frames=5)
    words = (f"camera={camera[0]}", f"camera.{camera[1]}={tmp_path / 'film.mp4'}")
    watched, itself = (Bench(composed("demo-record", "robot=ideal", *more)) for more in (words, ()))
    assert not shows_the_arm(watched)
    assert shows_the_arm(itself)
    watched.close()


def test_ones_own_configurations_are_named_in_what_follows():
    assert shlex.split(reach_with("run", TYPED))[3] == "--config-dir=my arms"


def test_a_robot_of_ones_own_is_found_by_the_command_that_is_said_to_follow(imitate):
    a_robot_of_ones_own(imitate.folder, "ideal")
    demo = imitate("demo-record", "--config-dir", "my arms", "robot=mine")
    learn, replay = said_by(demo.stdout)
    learned = imitate(*learn)
    [reach] = said_by(learned.stdout)
    assert [imitate(*words).exit_code for words in (replay, reach)] == [0, 0]


def test_an_arm_of_ones_own_that_does_not_answer_can_be_doctored(imitate):
    a_robot_of_ones_own(imitate.folder, "so101")
    words = ("--config-dir", "my arms", "robot=mine", "robot.arm.address=nowhere")
    failed = imitate("learn-map", *words)
    assert failed.exit_code == 3
    doctor = shlex.split(failed.stderr.partition("type ")[2].partition(";")[0])[1:]
    told = json.loads(imitate(*doctor, "--json").stdout)
    [arm] = [one for one in told if one["subject"] == "arm"]
    assert arm["verdict"] == "fail" and "nowhere" in arm["told"]


def test_a_folder_of_ones_own_that_is_not_there_is_bad_input(imitate):
    result = imitate("doctor", "--config-dir", "nowhere", "robot=ideal")
    assert result.exit_code == 2
    assert "nowhere is no folder" in result.stderr
