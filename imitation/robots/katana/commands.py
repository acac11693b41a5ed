"""The Katana's commands: payloads of requests, and what replies tell (facts/katana.md, 2.3)."""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

from imitation.arrays import Array

MOTORS = range(1, 7)  # 6 is the gripper's
SENSOR_CONTROLLER = 15
VERSION = b"B"
IDENTITY = b"Y"
ECHO = b"Z"
ALL_STATUS = b"N\x01\x00"
ALL_POSITIONS = b"N\x03\x00"
SENSORS = bytes((ord("E"), SENSOR_CONTROLLER))
TICK = 0.01  # the protocol's unit of time [s]


class Flag(IntEnum):
    """What C makes of a motor."""

    OFF = 0
    CALIBRATE = 4
    FREEZE = 8
    MOVE = 24
    CLEAR = 32  # the move buffer; a 300 must never get it


class Status(IntEnum):
    """What a motor says of itself."""

    OFF = 0
    CALIBRATING = 4
    HOLDING = 8
    MOVING = 16
    NORMAL = 24
    CRASHED = 40
    SPLINE_DONE = 88
    BUFFER_FULL = 152


class Setting(IntEnum):
    """Subcommands of S that set something."""

    CONTROLLER = 1
    PWM = 2
    SPEED = 3
    ACCELERATION = 4
    CRASH_LIMIT = 5
    CRASH_LIMIT_LINEAR = 6


@dataclass(frozen=True)
class MotorReading:
    """A reply to D. The sign of the velocity is not to be relied on."""

    motor: int
    status: int
    position: int  # [encoders]
    velocity: int  # [encoders / 10 ms]
    pwm: int


@dataclass(frozen=True)
class Segment:
    """A spline of one motor: p0 + p1 t/64 + p2 t^2/1024 + p3 t^3/32768, t in 10 ms."""

    ticks: int
    target: int  # where the motor is at the end [encoders]
    p0: int
    p1: int
    p2: int
    p3: int


def steady(start: int, target: int, ticks: int) -> Segment:
    """From `start` to `target` [encoders] at a steady speed."""
    return Segment(ticks, target, start, round((target - start) * 64 / ticks), 0, 0)


def motor_version(motor: int) -> bytes:
    """V: firmware of a motor's controller."""
    return bytes((ord("V"), motor, 32))


def motor_command(motor: int, flag: Flag, position: int) -> bytes:
    """C: move, freeze, switch off or calibrate a motor; motor 0 is all of them."""
    return struct.pack(">cBBh", b"C", motor, flag, position)


def set_counter(motor: int, flag: Flag, position: int) -> bytes:
    """C with 128 added: the encoder counter becomes `position`, nothing moves."""
    return motor_command(motor + 128, flag, position)


def read_motor(motor: int) -> bytes:
    """D: read one motor."""
    return bytes((ord("D"), motor))


def set_parameter(motor: int, setting: Setting, *values: int) -> bytes:
    """S: set up to three bytes of a motor's parameter."""
    return bytes((ord("S"), motor, setting, *values, *bytes(3 - len(values))))


def crash_limits(on: bool) -> bytes:
    """A: stop a motor that collides, or do not."""
    return bytes((ord("A"), 0, on))


def all_segments(segments: Sequence[Segment], more: bool, exact: int) -> bytes:
    """H: a spline for each of the six motors, and start."""
    body = b"".join(
        struct.pack(">Hhhhhh", one.ticks, one.target, one.p0, one.p1, one.p2, one.p3)
        for one in segments
    )
    return b"H" + body + bytes((0 if more else 1, exact))


def motor_of(reply: bytes) -> MotorReading:
    """What a reply to D tells."""
    return MotorReading(*struct.unpack(">xBBhhB", reply))


def positions_of(reply: bytes) -> tuple[int, ...]:
    """Encoders of the six motors, from a reply to N 3."""
    return struct.unpack(">x6h", reply)


def statuses_of(reply: bytes) -> tuple[int, ...]:
    """Status of the six motors, from a reply to N 1."""
    return tuple(reply[1:7])


def sensors_of(reply: bytes) -> tuple[int, ...]:
    """The 16 sensors, from a reply to E."""
    return tuple(reply[2:18])


def version_of(reply: bytes) -> tuple[int, int]:
    """Version and revision, from a reply to B."""
    return reply[1], reply[2]


def identity_of(reply: bytes) -> str:
    """The text of a reply to Y."""
    return reply[1:82].decode("ascii", "replace").rstrip("\0 \r\n")


def as_segments(starts: Array, targets: Array, ticks: int) -> list[Segment]:
    """Steady movements of the six motors from `starts` to `targets` (6,) [encoders]."""
    return [
        steady(int(start), int(target), ticks)
        for start, target in zip(starts, targets, strict=True)
    ]
