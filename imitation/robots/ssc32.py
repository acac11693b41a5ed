"""A neck of two servos on an SSC-32 servo controller (facts/katana.md, 4)."""

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack, closing
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.device import DeviceError
from imitation.robot import Camera
from imitation.robots.camera_on_neck import CameraOnNeck
from imitation.robots.line import Line
from imitation.robots.serial_line import SerialLine

STEP = 10  # QP tells pulses in this [us]


@dataclass(frozen=True)
class Servo:
    """One servo of the neck.

    Args:
        channel: Of the board.
        centre: Pulse at which the camera looks along its own gaze [us].
        per_radian: Pulse for each radian up or to the left [us/rad]; negative: the other way.
        lower: Smallest pulse that the mount bears [us].
        upper: Largest [us].
    """

    channel: int
    centre: int
    per_radian: float
    lower: int
    upper: int

    def pulse(self, angle: float) -> int:
        """Pulse for an angle from the centre [rad], within the mount's limits [us]."""
        return round(float(np.clip(self.centre + angle * self.per_radian, self.lower, self.upper)))

    def angle(self, pulse: float) -> float:
        """Angle from the centre at a pulse [rad]."""
        return (pulse - self.centre) / self.per_radian


class Ssc32Neck:
    """Turns a camera. The board is told once, then asked: it says nothing by itself.

    Args:
        line: To the board.
        servos: Pan and tilt.
        straight: Gaze at the servos' centres, (2,) [rad].
        speed: How fast the camera turns [rad/s].
        timeout: For a reply [s].
        watch: How often the board is asked whether it still knows its servos [s].
        clock: The time [s].

    Raises:
        DeviceError: The board does not answer.
    """

    def __init__(
        self,
        line: Line,
        servos: Sequence[Servo],
        straight: Array,
        speed: float,
        timeout: float,
        watch: float,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._line, self._servos, self._straight = line, servos, straight
        self._speed, self._timeout, self._watch, self._clock = speed, timeout, watch, clock
        self.version = board_version(line, timeout)
        self._from: list[float] = [servo.centre for servo in servos]
        self._to = [servo.centre for servo in servos]
        self._began, self._lasts, self._looked = clock(), 0.0, clock()
        self._awake = False

    def wake(self) -> None:
        """Go to the centre, once, at full speed: the board does not know where a servo is.

        Whatever else the first move is told is not obeyed.
        """
        if not self._awake:
            self._tell(self._group(self._to))
            self._awake = True

    def turn(self, gaze: Array) -> None:
        """Turn to `gaze` (pan, tilt) [rad], within the mount's limits; not to what is no number."""
        if not np.isfinite(gaze).all():
            return
        angles = gaze - self._straight
        wanted = [servo.pulse(one) for servo, one in zip(self._servos, angles, strict=True)]
        if wanted != self._to:
            self._began, self._from = self._clock(), self._pulses(self._clock())
            turn = self._gaze_of(wanted) - self._gaze_of(self._from)
            self._to, self._lasts = wanted, float(np.abs(turn).max()) / self._speed
            self._tell(f"{self._group(wanted)}T{max(round(self._lasts * 1000), 1)}")

    def gaze(self, ago: float) -> Array:
        """Pan and tilt, (2,) [rad], so many seconds ago."""
        return self._gaze_of(self._pulses(self._clock() - ago))

    def check(self) -> None:
        """Now and then, ask whether the board still holds the servos where it was told.

        Raises:
            DeviceError: It does not answer, or has forgotten them.
        """
        now = self._clock()
        if not self._awake or now - self._looked < self._watch:
            return
        self._looked = now
        if now < self._began + self._lasts + self._watch:
            return
        held = pulses_at(self._line, [servo.channel for servo in self._servos], self._timeout)
        for servo, pulse, one in zip(self._servos, self._to, held, strict=True):
            if abs(one - pulse) > STEP:
                raise DeviceError(
                    f"the neck's servo on channel {servo.channel} should be at {pulse} us and "
                    f"is at {one}: the board has started anew; check its power supply"
                )

    def close(self) -> None:
        """Release the line; the board holds the servos where they are."""
        self._line.close()

    def _group(self, pulses: Sequence[int]) -> str:
        return "".join(
            f"#{servo.channel}P{pulse}" for servo, pulse in zip(self._servos, pulses, strict=True)
        )

    def _pulses(self, at: float) -> list[float]:
        share = 1.0 if self._lasts <= 0 else (at - self._began) / self._lasts
        share = min(max(share, 0.0), 1.0)
        return [a + share * (b - a) for a, b in zip(self._from, self._to, strict=True)]

    def _gaze_of(self, pulses: Sequence[float]) -> Array:
        angles = [servo.angle(one) for servo, one in zip(self._servos, pulses, strict=True)]
        return np.asarray(self._straight + np.array(angles))

    def _tell(self, line: str) -> None:
        self._line.send(line.encode() + b"\r")


def board_version(line: Line, timeout: float) -> str:
    """What the board at the other end of `line` says it is.

    Raises:
        DeviceError: It says nothing, or is none.
    """
    told = ask(line, "VER", timeout, until=b"\r").decode("ascii", "replace").strip()
    if not told.startswith("SSC32"):
        raise DeviceError(f"at {line.name} is no SSC-32: it says {told[:20]!r} to VER")
    return told


def pulses_at(line: Line, channels: Sequence[int], timeout: float) -> list[int]:
    """Pulses that the board sends on its `channels` [us]; 0: none, it was never told."""
    asked = "".join(f"QP{channel}" for channel in channels)
    return [one * STEP for one in ask(line, asked, timeout, count=len(channels))]


def ask(line: Line, asked: str, timeout: float, until: bytes = b"", count: int = 0) -> bytes:
    """What the board replies: so many bytes, or all `until` its end."""
    line.drain()
    line.send(asked.encode() + b"\r")
    received = b""
    while len(received) < count or (until and not received.endswith(until)):
        more = line.receive(1, timeout)
        if not more:
            raise DeviceError(
                f"the neck at {line.name} is silent after {asked}: check its power, its cable "
                "and its baud rate (neck.baud)"
            )
        received += more
    return received


def ssc32_neck(
    camera: Camera,
    gaze: Sequence[float],
    port: str,
    baud: int,
    pan: Mapping[str, float],
    tilt: Mapping[str, float],
    speed: float,
    timeout: float,
    watch: float,
) -> CameraOnNeck:
    """`camera` on a neck at a serial port, looking along its own `gaze` [rad]."""
    with ExitStack() as opened:
        line = opened.enter_context(closing(SerialLine(port, baud, timeout)))
        servos = [_servo(**one) for one in (pan, tilt)]
        neck = Ssc32Neck(line, servos, np.asarray(gaze, dtype=float), speed, timeout, watch)
        opened.pop_all()
    return CameraOnNeck(camera, neck)


def _servo(channel: float, centre: float, per_radian: float, lower: float, upper: float) -> Servo:
    return Servo(int(channel), int(centre), per_radian, int(lower), int(upper))
