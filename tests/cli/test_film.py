"""A film from the command line to the recording."""

import json
import threading
from pathlib import Path

import numpy as np
import pytest
import rerun as rr
from made_up_films import film, film_of_an_action
from rosbags.typesys import Stores, get_typestore

from imitation.recording.mcap_recording import Recording

OF_A_PERSON = Path(__file__).parents[3] / "shared" / "videos" / "hand_and_cup.mp4"


def watched(imitate, name: str, path: Path, *words: str) -> Path:
    """Folder of a run of demo-record that watched a film."""
    given = ["robot=ideal", "camera=video", f"camera.path={path}", f"out={name}", *words]
    result = imitate("demo-record", *given)
    assert result.exit_code in (0, 1), result.output
    return imitate.folder / name


@pytest.fixture
def run(imitate):
    return watched(imitate, "run", film(imitate.folder / "film.mp4", frames=60, rate=60))


@pytest.mark.parametrize(
    ("words", "code"), [(("neck=ssc32", "neck.port=nowhere"), 3), (("fault=camera_black",), 2)]
)
def test_a_camera_is_closed_when_what_belongs_to_it_cannot_be_had(imitate, words, code):
    shown = film(imitate.folder / "film.mp4", frames=60, rate=60)
    live = ("robot=ideal", "camera=webcam", f"camera.device={shown}")
    assert imitate("demo-record", *live, *words).exit_code == code
    assert "camera" not in [thread.name for thread in threading.enumerate()]


def metrics(run: Path) -> dict:
    return json.loads((run / "metrics.json").read_text())


def test_every_frame_of_a_film_is_recorded_at_its_time_as_jpeg(run):
    recording = Recording.open(run)
    frames = list(recording.messages("/camera/image"))
    assert recording.topics["/camera/image"].type == "sensor_msgs/msg/CompressedImage"
    assert [time for time, _ in frames] == pytest.approx(np.arange(60) / 60 * 1e9, abs=1e6)
    assert {frame.format for _, frame in frames} == {"jpeg"}
    used = [message.stamp for _, message in recording.messages("/camera/used")]
    assert {one.sec * 10**9 + one.nanosec for one in used} <= {time for time, _ in frames}


def test_frames_used_repeated_and_skipped_are_counted(run, imitate):
    told = metrics(run)
    assert told["frames_used"] + told["frames_skipped"] == 60
    assert (told["frames_repeated"], told["steps"]) == (0, told["frames_used"])
    slow = metrics(watched(imitate, "slow", film(imitate.folder / "slow.mp4", 10, rate=10)))
    assert (slow["frames_used"], slow["frames_skipped"]) == (10, 0)
    assert slow["frames_repeated"] == slow["steps"] - 10


def test_what_a_film_shows_is_printed(imitate):
    path = film(imitate.folder / "film.mp4", 25)
    given = ["robot=ideal", "camera=video", f"camera.path={path}"]
    told = imitate("demo-record", *given).stdout
    assert "25, 0.04 s apart at most" in told
    assert "seen in 100% of the steps" in told
    assert "apart at most" not in imitate("demo-record", "robot=ideal").stdout


def test_the_same_film_gives_the_same_bytes_wherever_it_lies(run, imitate):
    (imitate.folder / "elsewhere").mkdir()
    moved = (imitate.folder / "film.mp4").rename(imitate.folder / "elsewhere" / "named.mp4")
    again = watched(imitate, "again", moved)
    assert (again / "run.mcap").read_bytes() == (run / "run.mcap").read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("vision", ["red_tag", "movement"])
def test_what_was_decided_on_a_film_is_decided_so_anew(imitate, vision):
    run = watched(imitate, "run", film(imitate.folder / "film.mp4", 60, 60), f"vision={vision}")
    result = imitate("verify", str(run))
    assert result.exit_code == 0, result.output


def test_an_action_seen_in_a_film_is_replayed_from_its_first_state(imitate, learned):
    path = film_of_an_action(imitate.folder / "film.mp4")
    action = watched(imitate, "seen", path)
    states = json.loads((action / "action.json").read_text())["states"]
    assert [state["area"] for state in states] == [[2, 1], [2, 3]]
    words = ["robot=ideal", "camera=video", f"camera.path={path}", "object=null", "out=done"]
    result = imitate("replay", f"map={learned}", f"action={action}", *words)
    assert result.exit_code == 0, result.output
    told = metrics(imitate.folder / "done")
    assert (told["triggered_by_state"], told["states_replayed"]) == (0, 1)


def test_the_rerun_file_shows_the_frames(run):
    told = rr.chunk.RrdReader(run / "run.rrd").stream().filter(content="/camera/image")
    rows = sum(chunk.num_rows for chunk in told.to_chunks() if "run_time" in chunk.timeline_names)
    assert rows == 60


def test_other_tools_read_the_frames(run):
    """With ROS 2's own definitions, as rosbags has them."""
    recording, store = Recording.open(run), get_typestore(Stores.ROS2_HUMBLE)
    (first, *_) = (m for chunk in recording.chunks() for m in chunk if m.topic == "/camera/image")
    told = store.deserialize_cdr(first.data, "sensor_msgs/msg/CompressedImage")
    assert told.data[:2].tobytes() == b"\xff\xd8"


@pytest.mark.parametrize(
    ("words", "code", "told"),
    [
        (["camera=video"], 2, "camera.path"),
        (["camera=video", "camera.path=nowhere.mp4"], 2, "no film at camera.path=nowhere.mp4"),
        (["camera=video", "camera.path=nowhere.mp4", "camera.aspect=fill"], 2, "camera.aspect"),
        (["camera=webcam", "camera.device=/dev/video99"], 3, "cannot be opened"),
        (["camera=webcam", "camera.stale=0"], 2, "camera.stale"),
    ],
)
def test_a_camera_that_is_not_there_is_told_in_one_line(imitate, words, code, told):
    result = imitate("demo-record", "robot=ideal", *words)
    assert result.exit_code == code
    assert told in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1


@pytest.mark.skipif(not OF_A_PERSON.is_file(), reason="the film of a person is not here")
def test_the_hand_of_a_person_is_seen_in_every_frame(imitate):
    run = watched(imitate, "run", OF_A_PERSON, "vision=skin")
    assert metrics(run)["frames_used"] + metrics(run)["frames_skipped"] == 217
    hands = [one.point for _, one in Recording.open(run).messages("/hand")]
    assert len(hands) == metrics(run)["steps"]
    places = np.array([(one.x, one.y) for one in hands])
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() < 8
    assert np.ptp(places[:, 0]) > 60  # from right to left and back, the hand and not its arm


@pytest.mark.skipif(not OF_A_PERSON.is_file(), reason="the film of a person is not here")
def test_the_arm_follows_the_hand_of_a_person(imitate, learned):
    words = ["camera=video", f"camera.path={OF_A_PERSON}", "vision=skin", "selection=soft"]
    result = imitate("mimic", f"map={learned}", "robot=ideal", *words, "out=run")
    assert result.exit_code == 0, result.output
    told = metrics(imitate.folder / "run")
    assert told["correlation"] > 0.95
    assert told["path_rmse_px"] < 6
