"""Feetech STS or Dynamixel X servos on one serial bus. The one module that knows rustypot."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import rustypot

from imitation.arrays import Array, Mask
from imitation.device import DeviceError
from imitation.robots.servo_kinds import STEP, TURN, Register, ServoKind

QUIET = 0.02  # after a spoilt reply: what still comes would be taken for the next one [s]


@dataclass(frozen=True)
class ServoReport:
    """What servos say of themselves; each of (n,)."""

    firmware: tuple[str, ...]
    voltage: Array  # [V]
    temperature: Array  # [degrees Celsius]
    hottest: Array  # at which each gives up [degrees Celsius]
    torque_limit: Array  # [share of what it can]
    torque_on: Mask


class ServoBus:
    """All servos of an arm, asked and told together; 0 rad is the middle of a servo's turn.

    Every request may be repeated: targets are absolute.

    Args:
        port: Its device file.
        kind: What the servos are.
        ids: Of the servos, in the order of a posture.
        baud: Bits per second.
        timeout: For a reply [s].
        tries: How often a request is sent before the bus counts as dead.

    Raises:
        DeviceError: A servo does not answer, is another model, or is set up for something else.
    """

    def __init__(
        self,
        port: str,
        kind: ServoKind,
        ids: Sequence[int],
        baud: int,
        timeout: float,
        tries: int,
    ) -> None:
        self.name, self._kind, self._ids, self._tries = port, kind, list(ids), tries
        definition = getattr(rustypot, f"{kind.definition}PyController").definition()
        try:
            self._servos = rustypot.Bus(port, baud, timeout, dict.fromkeys(ids, definition))
        except (RuntimeError, OSError) as error:
            raise DeviceError(f"serial port {port} cannot be opened: {error}") from error
        self._refuse_others()

    def angles(self) -> Array:
        """Where the servos are (n,) [rad]."""
        return self._angles("present_position")

    def limits(self) -> tuple[Array, Array]:
        """Lowest and highest angles that the servos themselves allow (n,) [rad]."""
        return self._angles("min_position_limit"), self._angles("max_position_limit")

    def turn_to(self, angles: Array) -> None:
        """Let the servos turn to `angles` (n,) [rad]; they hold them until told otherwise."""
        self._write("goal_position", np.round(angles / STEP + TURN // 2))

    def limit(self, speed: Array, acceleration: Array, torque: Array) -> None:
        """Limit speed [rad/s], acceleration [rad/s^2] and torque [share of what they can]; (n,)."""
        kind = self._kind
        for register, values in (
            (kind.acceleration, np.ceil(acceleration / kind.acceleration.unit)),
            (kind.speed, np.ceil(speed / kind.speed.unit)),
            (kind.torque, np.round(torque / kind.torque.unit)),
        ):
            # To most of them 0 means without a limit.
            self._write(register.name, np.clip(values, 1, register.largest))

    def torque(self, on: bool) -> None:
        """Switch all motors on or off."""
        self._write("torque_enable", np.full(len(self._ids), on))

    def loads(self) -> Array:
        """What the servos press with, (n,) [share of what they can]."""
        return np.abs(self._shares(self._kind.load))

    def report(self) -> ServoReport:
        """What the servos say of themselves."""
        versions = np.array([self._read(one) for one in self._kind.firmware]).T
        return ServoReport(
            firmware=tuple(".".join(f"{part:.0f}" for part in one) for one in versions),
            voltage=self._read(self._kind.voltage) * 0.1,
            temperature=self._read("present_temperature"),
            hottest=self._read(self._kind.hottest),
            torque_limit=self._shares(self._kind.torque),
            torque_on=self._read("torque_enable") > 0,
        )

    def refuse_troubled(self) -> None:
        """Raise a DeviceError when a servo is in trouble."""
        for number, status in zip(self._ids, self._read(self._kind.trouble), strict=True):
            told = [word for bit, word in self._kind.wrong.items() if int(status) & bit]
            if told:
                raise DeviceError(
                    f"servo {number} at {self.name} tells of its {' and '.join(told)}: switch the "
                    "arm off, let it cool, and see what holds it"
                )

    def close(self) -> None:
        """Release the port; harmless when repeated."""
        self._servos.close()

    def _refuse_others(self) -> None:
        for number, model in zip(self._ids, self._read("model_number"), strict=True):
            if model not in self._kind.models:
                known = ", ".join(f"{name} ({one})" for one, name in self._kind.models.items())
                raise DeviceError(
                    f"servo {number} at {self.name} is model {model:.0f}, not {known}; set "
                    "robot.arm.servos to what it is"
                )
        for register, bits, wanted, called in self._kind.needed:
            for number, value in zip(self._ids, self._read(register), strict=True):
                if int(value) & bits != wanted:
                    raise DeviceError(
                        f"servo {number} at {self.name} needs {called}, its {register} is "
                        f"{value:.0f}: set it with its maker's program"
                    )

    def _angles(self, register: str) -> Array:
        return (self._read(register) - TURN // 2) * STEP

    def _shares(self, register: Register) -> Array:
        return self._read(register.name) * register.unit

    def _read(self, register: str) -> Array:
        told = self._tried(lambda: self._servos.sync_read_register(self._ids, register))
        return np.asarray(told, dtype=float)

    def _write(self, register: str, values: Array) -> None:
        told = [int(one) for one in values]
        self._tried(lambda: self._servos.sync_write_register(self._ids, register, told))

    def _tried(self, call: Callable[[], Any]) -> Any:
        lost: BaseException | None = None
        for _ in range(self._tries):
            try:
                answer = call()
                if lost:
                    time.sleep(QUIET)
                return answer
            except BaseException as error:
                if not (isinstance(error, RuntimeError | OSError) or panicked(error)):
                    raise
                lost = error
                time.sleep(QUIET)
        raise DeviceError(
            f"the servos at {self.name} do not answer ({lost}): see to their power and cable"
        ) from lost


def panicked(error: BaseException) -> bool:
    """Whether rustypot broke off over a reply of the wrong length; its exception has no module."""
    return type(error).__name__ == "PanicException"
