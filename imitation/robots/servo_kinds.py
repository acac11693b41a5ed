"""What Feetech STS and Dynamixel X servos call the same things, and in which units.

Data of the devices, not to be tuned. Names are those of rustypot's definitions.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

TURN = 4096  # steps of all their encoders
STEP = 2 * np.pi / TURN  # [rad]


@dataclass(frozen=True)
class Register:
    """A register of whole numbers.

    Args:
        name: Its name.
        unit: What 1 means.
        largest: The largest number it takes.
    """

    name: str
    unit: float
    largest: int


@dataclass(frozen=True)
class ServoKind:
    """Servos that are driven alike.

    Args:
        definition: Whose registers they have, in rustypot.
        models: Their names, by the model numbers they tell.
        needed: Settings they must have: register, bits of it, their value, and what that is called.
        speed: Largest speed [rad/s].
        acceleration: Largest acceleration [rad/s^2].
        torque: Largest torque [share of what they can].
        load: What they press with now [share of what they can].
        trouble: Register that tells of trouble.
        wrong: What its bits mean.
        voltage: Register of the supply's voltage, 0.1 V each.
        hottest: Register of the temperature at which they give up.
        firmware: Registers of their firmware's version.
    """

    definition: str
    models: Mapping[int, str]
    needed: tuple[tuple[str, int, int, str], ...]
    speed: Register
    acceleration: Register
    torque: Register
    load: Register
    trouble: str
    wrong: Mapping[int, str]
    voltage: str
    hottest: str
    firmware: tuple[str, ...]


STS = ServoKind(
    definition="Sts3215",
    models={777: "STS3215"},
    needed=(("operating_mode", 0xFF, 0, "position mode (0)"),),
    speed=Register("goal_speed", STEP, 4095),
    acceleration=Register("acceleration", 100 * STEP, 254),
    torque=Register("torque_limit", 1 / 1000, 1000),
    load=Register("present_load", 1 / 1000, 1000),
    trouble="status",
    wrong={1: "voltage", 2: "sensor", 4: "temperature", 8: "current", 32: "overload"},
    voltage="present_voltage",
    hottest="max_temperature_limit",
    firmware=("firmware_major_version", "firmware_minor_version"),
)


def _dynamixel(definition: str, models: Mapping[int, str], full_load: int) -> ServoKind:
    return ServoKind(
        definition=definition,
        models=models,
        needed=(
            ("operating_mode", 0xFF, 3, "position mode (3)"),
            ("drive_mode", 4, 0, "a velocity-based profile"),
        ),
        speed=Register("profile_velocity", 0.229 * 2 * np.pi / 60, 32767),
        acceleration=Register("profile_acceleration", 214.577 * 2 * np.pi / 3600, 32767),
        torque=Register("goal_pwm", 1 / 885, 885),
        load=Register("present_current", 1 / full_load, full_load),
        trouble="hardware_error_status",
        wrong={1: "voltage", 4: "temperature", 8: "encoder", 16: "current", 32: "overload"},
        voltage="present_input_voltage",
        hottest="temperature_limit",
        firmware=("firmware_version",),
    )


KINDS = {
    "sts3215": STS,
    "xl330": _dynamixel("Xl330", {1190: "XL330-M077", 1200: "XL330-M288"}, 1750),
    "xl430": _dynamixel("Xl430", {1060: "XL430-W250"}, 1000),
    "xm430": _dynamixel("Xl430", {1020: "XM430-W350", 1030: "XM430-W210"}, 1193),
}
