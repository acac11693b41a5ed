"""Has the camera or the arm moved since a map was learned?"""

import json

import numpy as np
import pytest

from cli.jobs.check_map import Allowed, Scatter, judged


def run(imitate, learned, *words: str):
    result = imitate("check-map", f"map={learned}", "robot=ideal", "out=here", *words)
    return result, json.loads((imitate.folder / "here" / "metrics.json").read_text())


def test_where_nothing_has_moved_the_map_is_good(imitate, learned):
    result, told = run(imitate, learned)
    assert result.exit_code == 0, result.stderr
    assert told["verdict"] == "nothing has moved"
    assert told["seen"] == told["visited"] == 5


def test_a_camera_that_was_knocked_is_told_with_how_far(imitate, learned):
    result, told = run(imitate, learned, "robot.head.gaze=[-0.14,-1.07]")
    assert result.exit_code == 1
    assert told["verdict"] == "the camera has moved"
    assert told["moved_px"][1] == pytest.approx(690 * 0.02, abs=4)  # it looks higher
    assert "relearn" in result.stderr


def test_a_camera_that_was_turned_by_one_degree_is_told(imitate, learned):
    result, told = run(imitate, learned, "camera.gaze=[-0.12,-1.09]")
    assert result.exit_code == 1
    assert told["verdict"] == "the camera has moved"


def test_a_hand_that_cannot_be_seen_is_told(imitate, learned):
    result, told = run(imitate, learned, "vision.hue=[60,70]")
    assert result.exit_code == 1
    assert told["verdict"] == "hand unseen"


def test_where_no_hand_is_seen_the_table_holds_no_number(imitate, learned):
    result, told = run(imitate, learned, "vision=skin")
    assert told["seen"] == 0
    assert "nan" not in result.stdout and " px" not in result.stdout


def test_a_posture_alone_has_to_be_farther_off():
    allowed = Allowed(tolerance=6.0, common=3.0, sure=3.0)
    assert judged(np.array([4.0, 0.0]), Scatter(0.0, 1), 0, allowed)[0] == "nothing has moved"
    assert judged(np.array([7.0, 0.0]), Scatter(0.0, 1), 0, allowed)[0] == "the camera has moved"


@pytest.mark.parametrize(
    ("moved", "scatter", "unseen", "verdict"),
    [
        ([1.0, 2.0], 1.0, 0, "nothing has moved"),
        ([8.0, 0.0], 1.0, 0, "the camera has moved"),
        ([4.0, 0.0], 1.4, 0, "the camera has moved"),
        ([4.0, 0.0], 4.0, 0, "nothing has moved"),  # so scattered, it may be chance
        ([8.0, 0.0], 9.0, 0, "the arm has moved"),
        ([1.0, 0.0], 1.0, 1, "hand unseen"),
        ([np.nan, np.nan], np.nan, 0, "hand unseen"),
    ],
)
def test_what_is_common_is_the_cameras_and_what_is_not_is_the_arms(moved, scatter, unseen, verdict):
    allowed = Allowed(tolerance=6.0, common=3.0, sure=3.0)
    told, complaint = judged(np.array(moved), Scatter(scatter, 5), unseen, allowed)
    assert told == verdict
    assert (complaint is None) == (verdict == "nothing has moved")
