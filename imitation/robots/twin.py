"""A twin of the robot: emulated devices move a simulated world, which a camera shows."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from imitation.arrays import Array, Image
from imitation.gaze import VisualSpace
from imitation.jpeg import encoded
from imitation.robots.bullet.arm import BulletArm
from imitation.robots.demonstrators import Demonstrator, Shown
from imitation.robots.faults import Faults, Kind
from imitation.robots.mjpeg import MjpegServer
from imitation.robots.spoilt_pictures import SPOILT
from imitation.robots.ssc32 import Servo
from imitation.robots.ssc32_emulator import Ssc32Emulator

CAMERA_FAULTS = {
    "camera_frozen": Kind("the camera shows the same picture again and again"),
    "camera_black": Kind("its pictures are black"),
    "camera_gone": Kind("it delivers nothing"),
    "tag_lost": Kind("there is no tag on the hand"),
    "two_tags": Kind("a second thing looks like the tag"),
}
# Of its pixels [0..255]: no two pictures of a real camera are equal, though nothing moves.
GRAIN = 2
ATTENTION = 3.0  # how long the robot has rested when a demonstrator takes it to watch [s]


class Emulated(Protocol):
    """An emulated arm, as the world behind its wire knows it."""

    sessions: int  # how often somebody began to talk to it

    def posture(self) -> Array:
        """Where its joints are, (n_joints,) [rad]."""

    def opening(self) -> float:
        """Of its gripper, 0 closed .. 1 open."""

    def feel(self, proximity: float, touching: bool) -> None:
        """What its gripper senses from now on: distance to a thing [m], and both fingers' touch."""


@dataclass
class Twin:
    """The world behind the wires.

    Args:
        arm: The simulated arm, which follows the emulated one.
        emulator: The emulated arm.
        board: The emulated board of the neck.
        servos: Pan and tilt, as the neck is built.
        space: Visual space of the camera.
        eye: Its optical centre, (3,) [m].
        straight: Its gaze at the servos' centres, (2,) [rad].
        demonstrator: Who else has a hand in view; None: nobody.
        stream: Where the camera's pictures go.
        rate: Pictures per second [Hz].
        quality: Of the JPEGs [1..100].
        faults: What goes wrong with the camera, counted from when the arm was first spoken to.
        rng: Draws the grain of its pictures.
    """

    arm: BulletArm
    emulator: Emulated
    board: Ssc32Emulator
    servos: Sequence[Servo]
    space: VisualSpace
    eye: Array
    straight: Array
    demonstrator: Demonstrator | None
    stream: MjpegServer
    rate: float
    quality: int
    faults: Faults = field(default_factory=Faults)
    rng: np.random.Generator = field(default_factory=np.random.default_rng)
    _shown: bytes = b""
    _spoken_at: float | None = None  # when the arm was first spoken to [s]
    _session: int = -1
    _quiet_since: float = 0.0  # the arm rests [s]
    _begun: float | None = None  # when the demonstrator began [s]; None: it waits
    _followed: Array = field(default_factory=lambda: np.zeros(0))  # where the arm was led [rad]

    def run(self, over: Callable[[], bool]) -> None:
        """Go on in real time until it is over."""
        self.begin()
        began = time.monotonic()
        step = 0
        while not over():
            step += 1
            self.advance(step / self.rate)
            time.sleep(max(began + step / self.rate - time.monotonic(), 0.0))

    def begin(self) -> None:
        """Put the simulated arm where the emulated one is."""
        self._followed = self.emulator.posture()
        self.arm.reset(self._followed)

    def advance(self, now: float) -> None:
        """Have the world follow the devices, and show it at `now` [s]."""
        posture, opening = self.emulator.posture(), self.emulator.opening()
        self._have_demonstrated(now, resting=bool((posture == self._followed).all()))
        # What the simulated arm could not follow at once, it makes up for; rounding is no way.
        to_go = np.round(posture - self.arm.led_to, 9)
        self.arm.move(to_go * self.rate, opening, 1 / self.rate)
        self._followed = posture
        felt = self.arm.read()
        self.emulator.feel(felt.proximity, felt.touching)
        since = self._since_spoken_to(now)
        if self.faults.at(since, "camera_gone"):
            return
        if not (self._shown and self.faults.at(since, "camera_frozen")):
            self._shown = encoded(self._picture(since)[..., ::-1].copy(), self.quality)
        self.stream.publish(self._shown)

    def _have_demonstrated(self, now: float, resting: bool) -> None:
        """A demonstrator begins when the robot of a new run has come to rest and watches."""
        if self.demonstrator is None:
            return
        if self.emulator.sessions != self._session:
            self._session, self._begun, self._quiet_since = self.emulator.sessions, None, now
        if not resting:
            self._quiet_since = now
        if self._begun is None and now - self._quiet_since >= ATTENTION:
            self._begun = now
        shown = Shown(None) if self._begun is None else self.demonstrator.at(now - self._begun)
        self.arm.scene.show(shown, self.demonstrator.hand)

    def gaze(self) -> Array:
        """Where the neck's servos turn the camera, (2,) [rad]."""
        pulses = self.board.pulses()
        angles = [one.angle(pulses.get(one.channel, one.centre)) for one in self.servos]
        return np.asarray(self.straight + np.array(angles))

    def _since_spoken_to(self, now: float) -> float:
        if self._spoken_at is None and self.emulator.sessions:
            self._spoken_at = now
        return 0.0 if self._spoken_at is None else now - self._spoken_at

    def _picture(self, since: float) -> Image:
        clean = self.arm.scene.photograph(self.space, self.eye, self.gaze())
        grain = self.rng.integers(-GRAIN, GRAIN + 1, clean.shape, dtype=np.int16)
        picture = np.asarray(np.clip(clean + grain, 0, 255), dtype=np.uint8)
        for name, spoil in SPOILT.items():
            if self.faults.at(since, name):
                picture = spoil(picture)
        return picture
