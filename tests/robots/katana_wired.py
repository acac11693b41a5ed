"""The Katana as an arm, over the wire to an emulated one whose time the test keeps."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from emulated import TIMEOUT, katana_device, served

from cli.build import Bench
from cli.experiments import composed
from imitation.robots.bodies import body_of
from imitation.robots.katana.arm import KatanaArm
from imitation.robots.katana.driver import Katana, connect
from imitation.robots.katana.models import MODELS
from imitation.robots.katana.sensors import GripperSensing
from imitation.robots.katana.start import Settings

TICK = 0.01  # [s]


class Wire:
    """Time that passes only when the test lets it, and what the motors did meanwhile."""

    def __init__(self, model: str, *faults: str) -> None:
        self.now = 0.0
        self.device = katana_device(model, *faults, speed=1.0)
        self.device.clock = lambda: self.now
        self.fastest = np.zeros(6)  # [encoders / tick]

    def pass_time(self, seconds: float) -> None:
        for _ in range(round(seconds / TICK)):
            self.now += TICK
            self.device.pass_time()
            speeds = [abs(motor.velocity) for motor in self.device.arm.motors]
            self.fastest = np.maximum(self.fastest, speeds)


@contextmanager
def wired(
    model: str, folder: Path, *faults: str, **driving: object
) -> Iterator[tuple[KatanaArm, Wire, Bench]]:
    """A driven arm, its wire, and the parts of its robot; `driving` changes its settings."""
    wire, made = Wire(model, *faults), MODELS[model]
    parts = Bench(composed("learn-map", "robot=katana", f"robot.arm.model={model}"))
    node = parts.cfg["robot"]["arm"]
    asked = {key: node[key] for key in ("name", "urdf", "joints", "base", "speed", "acceleration")}
    with served(wire.device, folder / "arm" if made.serial else None) as where:
        katana = Katana(connect(made, where, TIMEOUT, 4), made, sleep=wire.pass_time)
        settings = Settings(**{**node["driving"], **driving})
        sensing = GripperSensing(**node["sensing"])
        arm = KatanaArm(katana, body_of(**asked), settings, sensing, clock=lambda: wire.now)
        try:
            yield arm, wire, parts
        finally:
            arm.close()
