"""A film in the place of a camera."""

import re
from itertools import pairwise

import cv2
import numpy as np
import pytest
from made_up_films import film, picture
from on_bench import bench

from imitation.jpeg import decoded
from imitation.robot import Command
from imitation.robots.opencv_camera import cropped, framed

CODECS = {"mp4": "mp4v", "avi": "MJPG", "mkv": "FFV1", "webm": "VP80"}


def shown(path, *words):
    """All that a robot sees until the film ends."""
    parts = bench("learn-map", "robot=ideal", "camera=video", f"camera.path={path}", *words)
    robot = parts.robot
    seen = [robot.reset()]
    while not seen[-1].ended:
        seen.append(robot.step(Command(np.zeros(len(robot.home))))[0])
    robot.close()
    return parts, seen[:-1]


def captured(seen) -> list[int]:
    """When each frame that was delivered was captured [ns], skipped ones included."""
    times = []
    for one in seen:
        times += [shot.time_ns for shot in one.skipped]
        times += [one.frame_time_ns] if one.frame_time_ns not in times else []
    return times


def red_places(parts, seen) -> np.ndarray:
    perception = parts.perception(parts.field)
    return np.array([perception.perceive(one).hand for one in seen])


def test_a_film_at_the_rate_of_control_is_shown_frame_by_frame(tmp_path):
    _, seen = shown(film(tmp_path / "film.mp4", frames=30))
    assert [one.frame_time_ns for one in seen] == [one.time_ns for one in seen]
    assert len(seen) == 30


@pytest.mark.parametrize(("rate", "frames"), [(60, 90), (26.777, 50), (12.5, 20)])
def test_every_frame_is_delivered_once_by_the_clock_of_the_film(tmp_path, rate, frames):
    _, seen = shown(film(tmp_path / "film.mp4", frames, rate))
    times = captured(seen)
    assert len(times) == frames
    assert times == pytest.approx(np.arange(frames) / rate * 1e9, abs=1e6)
    assert all(earlier < later for earlier, later in pairwise(times))


@pytest.mark.parametrize("rate", [60, 12.5])
def test_the_newest_frame_is_decided_on_and_none_before_its_time(tmp_path, rate):
    _, seen = shown(film(tmp_path / "film.mp4", 40, rate))
    for one in seen[:-1]:
        assert 0 <= one.time_ns - one.frame_time_ns < 1e9 / rate + 1e6
        assert all(shot.time_ns < one.frame_time_ns for shot in one.skipped)


def test_what_is_seen_is_what_the_jpeg_holds(tmp_path):
    _, seen = shown(film(tmp_path / "film.mp4", frames=3))
    for one in seen:
        assert one.frame.shape == (120, 160, 3)
        assert (decoded(one.jpeg) == one.frame).all()


@pytest.mark.parametrize("body", ["ideal", "kuka_sim"])
def test_the_picture_is_the_visual_space_whatever_the_body(tmp_path, body):
    parts, seen = shown(film(tmp_path / "film.mp4", frames=5), f"robot={body}")
    places = red_places(parts, seen)
    assert places == pytest.approx(np.column_stack((np.linspace(40, 120, 5), [60] * 5)), abs=1)


def test_a_body_keeps_its_visual_space_when_it_looks_at_a_film(tmp_path):
    path = film(tmp_path / "film.mp4", frames=2)
    for body in ("katana_sim", "kuka_sim"):
        own = bench("learn-map", f"robot={body}")
        other = bench("learn-map", f"robot={body}", "camera=video", f"camera.path={path}")
        assert own.space == other.space


def test_a_mirrored_film_shows_left_on_the_right(tmp_path):
    parts, seen = shown(film(tmp_path / "film.mp4", frames=5), "camera.mirror=true")
    assert red_places(parts, seen)[:, 0] == pytest.approx(np.linspace(120, 40, 5), abs=1)


def test_a_part_of_a_film_begins_at_time_0(tmp_path):
    path = film(tmp_path / "film.mp4", frames=30)
    _, seen = shown(path, "camera.start=0.4", "camera.end=0.8")
    assert captured(seen) == pytest.approx(np.arange(10) * 40e6, abs=1e5)


def test_each_episode_shows_the_film_from_its_beginning(tmp_path):
    path = film(tmp_path / "film.mp4", frames=9)
    robot = bench("learn-map", "robot=ideal", "camera=video", f"camera.path={path}").robot
    still = Command(np.zeros(len(robot.home)))
    first = [robot.reset(), *(robot.step(still)[0] for _ in range(3))]
    second = [robot.reset(), *(robot.step(still)[0] for _ in range(3))]
    assert [one.jpeg for one in first] == [one.jpeg for one in second]
    assert [one.begins for one in second] == [True, False, False, False]
    assert second[0].frame_time_ns == second[0].time_ns == 160_000_000


def test_a_wide_picture_is_cropped_or_framed():
    wide = np.full((100, 400, 3), 200, dtype=np.uint8)
    wide[:, 150:250] = 50
    assert cropped(wide, (160, 120)).shape == framed(wide, (160, 120)).shape == (120, 160, 3)
    assert (cropped(wide, (160, 120))[:, 25:135] == 50).all()
    whole = framed(wide, (160, 120))
    assert not whole[:39].any() and not whole[81:].any() and whole[45:75].all()


@pytest.mark.parametrize(
    ("content", "words", "told"),
    [
        (None, [], "no film at"),
        (b"no film at all", [], "no film that OpenCV can read"),
        ("film", ["camera.start=9"], "camera.start=9"),
        ("film", ["camera.end=0.03"], "a single picture from camera.start=0"),
    ],
)
def test_what_is_no_film_is_refused_in_one_sentence(tmp_path, content, words, told):
    path = tmp_path / "film.mp4"
    if content == "film":
        film(path, frames=3)
    elif content:
        path.write_bytes(content)
    with pytest.raises(ValueError, match=told):
        shown(path, *words)


def test_a_picture_is_no_film(tmp_path):
    path = tmp_path / "picture.png"
    cv2.imwrite(str(path), picture(0.5))
    with pytest.raises(ValueError, match=r"shows a single picture; type camera.path=FILM"):
        shown(path)


@pytest.mark.parametrize("kind", ["mp4", "avi", "mkv", "webm"])
def test_a_film_that_was_cut_short_is_refused_and_a_whole_one_is_not(tmp_path, kind):
    path = film(tmp_path / f"film.{kind}", 25, 25.0, codec=CODECS[kind])
    assert len(captured(shown(path)[1])) == 25
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(ValueError, match=r"is cut short: \d+ bytes or more are missing"):
        shown(path)


def test_a_film_goes_on_after_pictures_that_are_damaged(tmp_path):
    path = film(tmp_path / "film.avi", 25, 25.0, codec="MJPG")
    content = bytearray(path.read_bytes())
    pictures = [found.start() for found in re.finditer(b"\xff\xd8", bytes(content))]
    for begins, ends in pairwise(pictures[10:14]):
        content[begins : ends - 16] = bytes(ends - 16 - begins)
    path.write_bytes(content)
    times = captured(shown(path)[1])
    assert 22 <= len(times) < 25
    assert times[-1] == pytest.approx(0.96e9, abs=1e6)
