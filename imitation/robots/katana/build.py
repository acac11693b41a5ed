"""Builds a Katana from plain values; `_target_` in the configuration names this."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from imitation.robots.bodies import body_of
from imitation.robots.katana.arm import KatanaArm
from imitation.robots.katana.commands import TICK
from imitation.robots.katana.driver import Katana, connect
from imitation.robots.katana.models import MODELS, for_slaves
from imitation.robots.katana.sensors import GripperSensing
from imitation.robots.katana.start import Settings

Numbers = Sequence[float]
ROUNDING = 1e-6  # of the URDF's limits [rad]


def katana_arm(
    name: str,
    urdf: str,
    joints: Sequence[str],
    base: Numbers,
    mark: Mapping[str, Any],
    speed: Numbers | None,
    acceleration: Numbers,
    model: int,
    address: str,
    timeout: float,
    tries: int,
    driving: Mapping[str, Any],
    sensing: Mapping[str, Any],
    period: float,
) -> KatanaArm:
    """A real Katana, or an emulated one; it is asked who it is, nothing moves.

    Its mark is a real one: what the configuration says of it is for simulated arms.

    Raises:
        DeviceError: It does not answer, or is another model.
    """
    if abs(period / TICK - round(period / TICK)) > ROUNDING:
        raise ValueError(f"period={period:g} s: the Katana counts in 10 ms; type period=0.16")
    made = MODELS[str(model)]
    katana = Katana(connect(made, address, timeout, tries), made)
    try:
        katana.model = for_slaves(made, katana.identity().motors[2][0])
        body = body_of(name, urdf, joints, base, speed, acceleration)
        lower, upper = katana.model.joint_limits
        body = replace(
            body,
            lower=np.maximum(body.lower, lower - ROUNDING),
            upper=np.minimum(body.upper, upper + ROUNDING),
        )
        return KatanaArm(katana, body, Settings(**driving), GripperSensing(**sensing))
    except Exception:
        katana.close()
        raise
