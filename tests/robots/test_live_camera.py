"""A live camera: real time, and rest while nothing new is seen."""

import time
from contextlib import contextmanager
from itertools import pairwise

import numpy as np
import pytest
from made_up_films import film
from mjpeg_server import serving
from on_bench import bench

from imitation.device import DeviceError
from imitation.robot import Command

QUICK = ("camera.stale=0.2", "camera.frozen=0.4", "camera.lost=1.5")


@contextmanager
def watching(device, *words):
    """A robot with a live camera."""
    given = ("robot=ideal", "camera=webcam", f"camera.device={device}", *QUICK, *words)
    robot = bench("learn-map", *given).robot
    try:
        yield robot
    finally:
        robot.close()


@pytest.fixture(scope="module")
def stream():
    with serving() as stream:
        yield stream


def steps(robot, count: int) -> list:
    """What is sensed and applied while the arm is told to move slowly to and fro."""
    found = []
    for step in range(count):
        way = 0.05 if step // 10 % 2 else -0.05
        found.append(robot.step(Command(np.full(len(robot.home), way))))
    return found


def reasons(found) -> list[str]:
    return [applied.reasons[0] if applied.reasons else "" for _, applied in found]


def test_the_clock_is_the_wall_s_and_frames_are_fresh(stream):
    with watching(stream.url) as robot:
        first = robot.reset()
        began = time.monotonic()
        seen = [one for one, _ in steps(robot, 50)]
        lasted = time.monotonic() - began
    assert first.time_ns == 0
    assert all(one.time_ns >= 40_000_000 * step for step, one in enumerate(seen, start=1))
    assert seen[-1].time == pytest.approx(lasted, abs=0.2)
    assert np.median([one.time_ns - one.frame_time_ns for one in seen]) < 200_000_000


def test_a_frame_s_time_is_that_of_its_capture_when_its_latency_is_known(stream):
    with watching(stream.url, "camera.latency=0.1", "camera.stale=0.3") as robot:
        seen = [robot.reset(), *(one for one, _ in steps(robot, 25))]
    ages = [one.time_ns - one.frame_time_ns for one in seen]
    assert 100_000_000 <= np.median(ages) < 300_000_000


def test_every_frame_is_kept_with_its_own_time(stream):
    with watching(stream.url) as robot:
        seen = [robot.reset(), *(one for one, _ in steps(robot, 50))]
    times = [0]
    for one in seen:
        times += [shot.time_ns for shot in one.skipped]
        times += [one.frame_time_ns] if one.frame_time_ns != times[-1] else []
    assert all(earlier < later for earlier, later in pairwise(times))
    assert len(times) == pytest.approx(2.0 * 30, rel=0.3)


@pytest.mark.parametrize(("fault", "told"), [("holds", "stale"), ("freezes", "frozen")])
def test_the_arm_rests_while_nothing_new_is_seen_and_goes_on_afterwards(stream, fault, told):
    with watching(stream.url) as robot:
        robot.reset()
        assert f"{told} vision" not in reasons(steps(robot, 5))
        getattr(stream, fault).set()
        found = steps(robot, 30)
        getattr(stream, fault).clear()
        assert reasons(found)[-1] == f"{told} vision"
        assert not found[-1][1].sent.any()
        assert found[-1][0].frame.any()  # never a black picture
        assert reasons(steps(robot, 20))[-5:] == [""] * 5


def test_a_camera_that_comes_back_is_used_again(stream):
    with watching(stream.url, "camera.lost=5") as robot:
        robot.reset()
        stream.hangs_up.set()
        assert reasons(steps(robot, 15))[-1] == "stale vision"
        stream.hangs_up.clear()
        assert reasons(steps(robot, 75))[-1] == ""


def test_a_camera_that_stays_away_fails_in_one_sentence(stream):
    with watching(stream.url) as robot:
        robot.reset()
        stream.hangs_up.set()
        with pytest.raises(DeviceError, match=r"no frame for 1.5 s"):
            steps(robot, 100)
        stream.hangs_up.clear()


@pytest.mark.parametrize("device", ["/dev/video99", "http://127.0.0.1:9/nothing", 99])
def test_a_camera_that_cannot_be_opened_fails_in_one_sentence(device):
    told = f"camera.device={device} cannot be opened"
    with pytest.raises(DeviceError, match=told) as error, watching(device):
        pass
    assert ("this machine has" in str(error.value)) is ("://" not in str(device))


def test_a_film_may_be_shown_as_if_it_were_live(tmp_path):
    path = film(tmp_path / "film.mp4", frames=30, rate=60)
    with watching(path) as robot:
        seen = [robot.reset()]
        while not seen[-1].ended:
            seen += [one for one, _ in steps(robot, 1)]
    frames = {one.frame_time_ns for one in seen}
    assert len(frames) + sum(len(one.skipped) for one in seen) == pytest.approx(30, abs=2)
    assert seen[-1].time == pytest.approx(0.5, abs=0.2)
