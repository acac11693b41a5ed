"""Drives a Katana: what it can be asked and told, checked (facts/katana.md, 2.3, 2.4)."""

import re
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.device import DeviceError
from imitation.robots.katana import commands
from imitation.robots.katana.commands import MOTORS, Flag, MotorReading, Segment, Setting, Status
from imitation.robots.katana.connection import Connection, RefusedError
from imitation.robots.katana.models import BAUD, PORT, Model
from imitation.robots.line import Line, TcpLine
from imitation.robots.serial_line import SerialLine

Sleep = Callable[[float], None]
HIGHEST = 65535  # TCP port
LOOK = 0.05  # between two looks at a movement [s]


def connect(model: Model, address: str, timeout: float, tries: int) -> Connection:
    """A connection to the arm at `address`: HOST[:PORT], or the serial port of a 300."""
    line: Line
    try:
        if model.serial:
            line = SerialLine(address, BAUD, timeout)
        else:
            line = TcpLine(*host_and_port(address), timeout)
    except DeviceError as error:
        raise DeviceError(
            f"no Katana: {error}; switch it on, check its cable, or type robot.arm.address=..."
        ) from error
    return Connection(line, model.tells_errors, timeout, tries)


def host_and_port(address: str) -> tuple[str, int]:
    """Of an arm over TCP; the port is the Katana's own when none is given."""
    match = re.fullmatch(r"([^:\s]+)(?::([0-9]{1,5}))?", address)
    port = int(match[2] or PORT) if match else 0
    if match is None or not 0 < port <= HIGHEST:
        raise ValueError(
            f"robot.arm.address={address} is no HOST or HOST:PORT, with a PORT of 1 to {HIGHEST}"
        )
    return match[1], port


@dataclass(frozen=True)
class Identity:
    """What an arm says of itself."""

    firmware: tuple[int, int]
    text: str
    motors: tuple[tuple[int, int], ...]  # firmware of each motor's controller


@dataclass
class Katana:
    """One arm.

    Args:
        connection: To it.
        model: What it should be.
        sleep: Waits for so many seconds.
    """

    connection: Connection
    model: Model
    sleep: Sleep = time.sleep

    def identity(self) -> Identity:
        """Who is there.

        Raises:
            DeviceError: It is not the model that was asked for.
        """
        motors = [self._ask(commands.motor_version(motor)) for motor in MOTORS]
        firmware = commands.version_of(self._ask(commands.VERSION))
        text = commands.identity_of(self._ask(commands.IDENTITY))
        if firmware[0] not in self.model.firmware:
            expected = " or ".join(f"{version}.x" for version in self.model.firmware)
            raise DeviceError(
                f"the arm has firmware {firmware[0]}.{firmware[1]} ({text}), a Katana "
                f"{self.model.name} has {expected}; set robot.arm.model to what it is"
            )
        return Identity(firmware, text, tuple((reply[3], reply[4]) for reply in motors))

    def positions(self) -> Array:
        """Encoders of all six motors, in one call, (6,)."""
        return np.array(commands.positions_of(self._ask(commands.ALL_POSITIONS)))

    def statuses(self) -> tuple[int, ...]:
        """Status of all six motors, in one call."""
        return commands.statuses_of(self._ask(commands.ALL_STATUS))

    def motor(self, number: int) -> MotorReading:
        """All that one motor tells."""
        return commands.motor_of(self._ask(commands.read_motor(number)))

    def sensors(self) -> tuple[int, ...]:
        """The gripper's 16 sensors."""
        return commands.sensors_of(self._ask(commands.SENSORS))

    def move(self, motor: int, encoder: int) -> None:
        """Let a motor go to `encoder` with its own ramp."""
        self._refuse_beyond(motor, encoder)
        self._control(motor, Flag.MOVE, encoder)

    def move_all(self, segments: Sequence[Segment]) -> None:
        """Let all six motors follow a segment each, in one call (H); not on a 300.

        Raises:
            BadReplyError: Nobody knows whether the arm obeyed: look where it is.
        """
        for motor, segment in zip(MOTORS, segments, strict=True):
            self._refuse_beyond(motor, segment.target)
        self.connection.ask_once(commands.all_segments(segments, more=False, exact=1))

    def freeze(self) -> None:
        """Stop every motor where it is, and hold."""
        if self.model.moves_all:
            # Splines first: a 300 must never get this, it makes it move.
            self._ask(commands.motor_command(0, Flag.CLEAR, 0))
        self._each_where_it_is(Flag.FREEZE)

    def switch_off(self) -> None:
        """Let every motor go limp."""
        self._each_where_it_is(Flag.OFF)

    def unblock(self) -> None:
        """Clear crash flags and switch all motors on, where they are: only on request."""
        self._each_where_it_is(Flag.FREEZE)

    def limit_crashes(self, on: bool) -> None:
        """Let the arm stop motors that collide, or not."""
        self._ask(commands.VERSION)
        self._ask(commands.crash_limits(on))

    def set_limits(self, speed: Sequence[int], acceleration: int) -> None:
        """Largest speed [encoders / 10 ms] of each motor and acceleration of all."""
        for motor, fastest in zip(MOTORS, speed, strict=True):
            self.set(motor, Setting.ACCELERATION, acceleration)
            self.set(motor, Setting.SPEED, fastest, fastest)

    def set(self, motor: int, setting: Setting, *values: int) -> None:
        """Set a motor's parameter."""
        self._ask(commands.set_parameter(motor, setting, *values))

    def set_counter(self, motor: int, flag: Flag, encoder: int) -> None:
        """Tell a motor of a 300 where it is."""
        self._ask(commands.set_counter(motor, flag, encoder))

    def control(self, motor: int, flag: Flag, encoder: int) -> None:
        """C, unchecked: for calibration, which has to leave the encoder's range."""
        self._control(motor, flag, encoder)

    def wait_until_near(self, targets: Array, tolerance: float, limit: float) -> None:
        """Wait until all motors are within `tolerance` [encoders] of `targets` (6,).

        Positions are compared: a 300 never says that it has arrived.

        Raises:
            DeviceError: A motor is blocked, or one is not there after `limit` [s].
        """
        until = time.monotonic() + limit
        while True:
            away = np.abs(self.positions() - targets)
            if (away < tolerance).all():
                return
            refuse_crashed(self.statuses())
            if time.monotonic() > until:
                motor = int(np.argmax(away)) + 1
                raise DeviceError(
                    f"motor {motor} is still {away[motor - 1]:.0f} encoders from where it was sent "
                    f"after {limit:.0f} s: see whether something holds it"
                )
            self.sleep(LOOK)

    def close(self) -> None:
        """Release the line; harmless when repeated."""
        self.connection.line.close()

    def _each_where_it_is(self, flag: Flag) -> None:
        failed: DeviceError | None = None
        for motor in MOTORS:
            try:  # one that fails must not keep the others going
                self._control(motor, flag, self.motor(motor).position)
            except RefusedError as error:
                failed = error
        if failed:
            raise failed

    def _control(self, motor: int, flag: Flag, encoder: int) -> None:
        self._ask(commands.motor_command(motor, flag, encoder))

    def _ask(self, request: bytes) -> bytes:
        return self.connection.ask(request)

    def _refuse_beyond(self, motor: int, encoder: int) -> None:
        lower, upper = self.model.motors[motor - 1].limits
        if not lower <= encoder <= upper:
            raise DeviceError(f"motor {motor} was to go to {encoder}, it has {lower} to {upper}")


def refuse_crashed(statuses: Sequence[int]) -> None:
    """Raise a DeviceError when a motor has collided."""
    for motor, status in zip(MOTORS, statuses, strict=True):
        if status == Status.CRASHED:
            raise DeviceError(
                f"motor {motor} has collided (status {status}): free the arm, then type "
                "robot.arm.driving.unblock=true"
            )
