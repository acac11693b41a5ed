"""Feetech STS3215 servos on one serial bus. The one module that knows rustypot."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from rustypot import Sts3215PyController

from imitation.arrays import Array, Mask
from imitation.device import DeviceError

MODEL = 777  # what an STS3215 says it is
STEP = 2 * np.pi / 4096  # of its encoder [rad]
QUIET = 0.02  # after a spoilt reply: what still comes would be taken for the next one [s]
FULL_TORQUE, FULL_ACCELERATION = 1000, 254  # the registers' largest values
ACCELERATION_STEP = 100 * STEP  # [rad/s^2]
WRONG = {1: "voltage", 2: "sensor", 4: "temperature", 8: "current", 32: "overload"}  # status bits


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
        ids: Of the servos, in the order of a posture.
        baud: Bits per second.
        timeout: For a reply [s].
        tries: How often a request is sent before the bus counts as dead.

    Raises:
        DeviceError: A servo does not answer, or is another model.
    """

    def __init__(
        self, port: str, ids: Sequence[int], baud: int, timeout: float, tries: int
    ) -> None:
        self.name, self._ids, self._tries = port, list(ids), tries
        try:
            self._servos = Sts3215PyController(port, baud, timeout)
        except (RuntimeError, OSError) as error:
            raise DeviceError(f"serial port {port} cannot be opened: {error}") from error
        for number, model in zip(ids, self._read("model_number"), strict=True):
            if model != MODEL:
                raise DeviceError(
                    f"servo {number} at {port} is model {model}, no STS3215 ({MODEL})"
                )

    def angles(self) -> Array:
        """Where the servos are (n,) [rad]."""
        return self._read("present_position")

    def limits(self) -> tuple[Array, Array]:
        """Lowest and highest angles that the servos themselves allow (n,) [rad]."""
        return self._read("min_angle_limit"), self._read("max_angle_limit")

    def turn_to(self, angles: Array) -> None:
        """Let the servos turn to `angles` (n,) [rad]; they hold them until told otherwise."""
        self._write("goal_position", angles.tolist())

    def limit(self, speed: Array, acceleration: Array, torque: float) -> None:
        """Limit speed [rad/s], acceleration [rad/s^2] and torque [share of what they can]."""
        hard = np.clip(np.ceil(acceleration / ACCELERATION_STEP), 1, FULL_ACCELERATION)
        self._write("acceleration", [int(one) for one in hard])
        self._write("raw_goal_speed", [int(one) for one in np.ceil(speed / STEP)])
        self._write("torque_limit", [round(torque * FULL_TORQUE)] * len(self._ids))

    def torque(self, on: bool) -> None:
        """Switch all motors on or off."""
        self._write("torque_enable", [on] * len(self._ids))

    def report(self) -> ServoReport:
        """What the servos say of themselves."""
        major, minor = (self._read(f"firmware_{part}_version") for part in ("major", "minor"))
        return ServoReport(
            firmware=tuple(f"{one:.0f}.{two:.0f}" for one, two in zip(major, minor, strict=True)),
            voltage=self._read("present_voltage") * 0.1,
            temperature=self._read("present_temperature"),
            hottest=self._read("max_temperature_limit"),
            torque_limit=self._read("torque_limit") / FULL_TORQUE,
            torque_on=self._read("torque_enable") > 0,
        )

    def refuse_troubled(self) -> None:
        """Raise a DeviceError when a servo is in trouble."""
        for number, status in zip(self._ids, self._read("status"), strict=True):
            told = [word for bit, word in WRONG.items() if int(status) & bit]
            if told:
                raise DeviceError(
                    f"servo {number} at {self.name} tells of its {' and '.join(told)}: switch the "
                    "arm off, let it cool, and see what holds it"
                )

    def close(self) -> None:
        """Release the port; harmless when repeated."""
        self._servos.close()

    def _read(self, register: str) -> Array:
        ask = getattr(self._servos, f"sync_read_{register}")
        return np.asarray(self._tried(lambda: ask(self._ids)), dtype=float)

    def _write(self, register: str, values: Sequence[Any]) -> None:
        tell = getattr(self._servos, f"sync_write_{register}")
        self._tried(lambda: tell(self._ids, values))

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
