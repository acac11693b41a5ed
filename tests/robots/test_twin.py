"""The twin: emulated devices move a simulated world, and a camera shows it."""

import threading
from contextlib import contextmanager

import cv2
import numpy as np
import pytest
from on_bench import bench

from imitation.robots.faults import Faults, read_fault
from imitation.robots.katana.emulated_arm import EmulatedArm
from imitation.robots.katana.emulator import KatanaEmulator
from imitation.robots.katana.models import MODELS
from imitation.robots.mjpeg import MjpegServer
from imitation.robots.opencv_camera import Development
from imitation.robots.ssc32 import Servo
from imitation.robots.ssc32_emulator import Ssc32Emulator
from imitation.robots.twin import CAMERA_FAULTS, Twin

SERVOS = (Servo(0, 1500, 636.6, 1000, 2000), Servo(1, 1500, 636.6, 1200, 1800))
HOME = np.array([0.0, 0.81, -1.16, 0.61, 0.0])


class Shown:
    """Keeps what the camera streams."""

    def __init__(self) -> None:
        self.pictures: list[np.ndarray] = []

    def publish(self, jpeg: bytes) -> None:
        picture = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
        self.pictures.append(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB))


@contextmanager
def twin(*faults: str):
    parts = bench("learn-map", "robot=katana_sim")
    emulator, board = KatanaEmulator(EmulatedArm(MODELS["400"])), Ssc32Emulator(clock=lambda: 0.0)
    model = emulator.arm.model
    for motor, encoder in zip(emulator.arm.motors, model.encoders(HOME), strict=False):
        motor.position = encoder
    shown = Shown()
    one = Twin(
        arm=parts.robot.arm,
        emulator=emulator,
        board=board,
        servos=SERVOS,
        space=parts.space,
        eye=np.array(parts.cfg["camera"]["eye"]),
        straight=np.array(parts.cfg["camera"]["gaze"]),
        demonstrator=None,
        stream=shown,
        rate=25.0,
        quality=100,
        faults=Faults([read_fault(fault, CAMERA_FAULTS) for fault in faults]),
    )
    one.begin()
    yield one, shown.pictures
    parts.robot.close()


def red(picture) -> np.ndarray:
    """Pixels of the tag, (n, 2) as x, y."""
    looks_red = (picture[..., 0] > 150) & (picture[..., 1] < 80)
    return np.argwhere(looks_red)[:, ::-1] + 0.5


@pytest.mark.parametrize("stride", [100, 2500])  # the second at once, faster than it can follow
def test_the_simulated_arm_follows_the_emulated_one(stride):
    with twin() as (one, _):
        motor = one.emulator.arm.motors[0]
        for step in range(25):
            motor.position += stride if step < 2500 / stride else 0
            one.advance(step / 25)
        posture, _ = one.arm.world.joint_state()
        encoders = np.array([motor.position for motor in one.emulator.arm.motors[:5]])
        assert posture == pytest.approx(one.emulator.arm.model.angles(encoders), abs=0.005)


def test_the_camera_shows_the_tag_where_it_truly_is():
    with twin() as (one, pictures):
        one.advance(0.0)
        mark, _ = one.arm.truth()
        wanted = one.space.project(mark, one.eye)
        assert red(pictures[-1]).mean(axis=0) == pytest.approx(wanted, abs=1.0)


def test_the_neck_turns_the_camera():
    with twin() as (one, pictures):
        one.advance(0.0)
        list(one.board.heard(b"#0P1500#1P1500\r#0P1530\r"))  # to the left
        one.advance(0.04)
        before, after = (red(picture).mean(axis=0) for picture in pictures)
        wanted = 690 * 30 / 636.6 * np.cos(1.09)  # the pan axis is upright, the camera looks down
        assert after[0] - before[0] == pytest.approx(wanted, abs=2.0)
        assert one.gaze()[0] == pytest.approx(-0.14 + 30 / 636.6)


def test_a_camera_may_show_black_nothing_new_or_nothing():
    with twin("camera_black@0-1", "camera_frozen@1-2", "camera_gone@2-3") as (one, pictures):
        one.emulator.sessions = 1
        one.advance(0.0)
        assert not pictures[-1].any()
        one.emulator.arm.motors[0].position += 200
        one.advance(1.0)
        assert not pictures[-1].any()
        one.advance(2.0)
        assert len(pictures) == 2
        one.advance(3.0)
        assert len(red(pictures[-1]))


def test_a_camera_goes_wrong_so_long_after_the_arm_was_first_spoken_to():
    with twin("camera_gone@1-2") as (one, pictures):
        one.advance(0.0)
        one.advance(1.5)
        one.emulator.sessions = 1
        for now in (5.0, 6.0, 6.9, 7.0):
            one.advance(now)
        assert len(pictures) == 4


def test_pictures_of_an_arm_at_rest_are_not_frozen():
    with twin() as (one, pictures):
        develop = Development(one.space.size, (0.0, 0.0), "crop", mirror=False, quality=95)
        for step in range(25):
            one.advance(step / 25)
        assert len({develop.jpeg(picture) for picture in pictures}) == 25


def test_the_tag_may_be_lost_or_doubled():
    with twin("tag_lost@1-2", "two_tags@2-3") as (one, pictures):
        one.emulator.sessions = 1
        for now in (0.0, 1.0, 2.0):
            one.advance(now)
        alone, lost, two = (len(red(picture)) for picture in pictures)
        assert lost == 0
        assert two > 1.5 * alone


def test_opencv_opens_the_stream_and_sees_the_newest_picture():
    stream, over = MjpegServer(0), threading.Event()
    _, jpeg = cv2.imencode(".jpg", np.full((120, 160, 3), (0, 0, 255), np.uint8))

    def show() -> None:
        while not over.wait(0.02):
            stream.publish(jpeg.tobytes())

    threading.Thread(target=show, daemon=True).start()
    source = cv2.VideoCapture(stream.url, cv2.CAP_FFMPEG)
    there, picture = source.read()
    over.set()
    source.release()
    stream.close()
    assert there
    assert picture[60, 80].tolist() == pytest.approx([0, 0, 255], abs=3)
