"""An arm of bus servos, over a serial port to emulated ones whose time the test keeps."""

from contextlib import contextmanager

import numpy as np
from emulated import served
from on_bench import bench

from imitation.robots.bodies import body_of, ideal_arm
from imitation.robots.emulated_servos import MAKES
from imitation.robots.faults import Faults, read_fault
from imitation.robots.servo_arm import Driving, ServoArm
from imitation.robots.servo_bus import ServoBus
from imitation.robots.servo_bus_emulator import FAULTS, ServoBusEmulator
from imitation.robots.servo_jaw import Jaw
from imitation.robots.servo_kinds import KINDS

PERIOD = 0.04  # [s]
TIMEOUT = 0.15  # for a reply: four of them outlast a late one [s]
IDS = (1, 2, 3, 4, 5)
GEOMETRY = ("name", "urdf", "joints", "base", "speed", "acceleration")


class Clock:
    """Time that passes when the test lets it."""

    now = 0.0

    def __call__(self) -> float:
        return self.now


class Wired(ServoArm):
    """An arm whose time goes on only while it moves, and whose hand can be seen."""

    live = False

    def __init__(self, servos: ServoBusEmulator, node: dict, bus: ServoBus, driving: Driving):
        self.servos = servos
        super().__init__(
            bus, body_of(**{one: node[one] for one in GEOMETRY}), driving, servos.clock
        )
        self.drawn = ideal_arm(**{one: node[one] for one in (*GEOMETRY, "mark")})
        self.scene = self.drawn.scene

    def reset(self, posture) -> None:
        super().reset(posture)
        while np.abs(posture - self.read().posture).max() > 0.01:
            step = np.clip(posture - self._sent[:5], -0.03, 0.03)
            self.move(step / PERIOD, None, PERIOD)

    def move(self, velocity, grip, period):
        sent = super().move(velocity, grip, period)
        self._angles()  # the command has no reply: one that has comes after it
        self.servos.clock.now += period
        self.drawn.reset(self._angles()[:5])
        return sent

    def truth(self):
        return self.drawn.truth()


@contextmanager
def wired(
    folder,
    *faults: str,
    servos: ServoBusEmulator | None = None,
    senses=(1, 1, 1, 1, 1),
    kind="sts3215",
    with_jaw=False,
):
    """An arm on its bus."""
    servos = servos or ServoBusEmulator(make=MAKES[kind])
    servos.clock = Clock()
    servos.faults = Faults([read_fault(one, FAULTS) for one in faults])
    node = bench("learn-map", "robot=so101").cfg["robot"]["arm"]
    jaw = Jaw(**node["jaw"]) if with_jaw else None
    driving = Driving(senses, node["torque"], node["following"], node["overdue"], jaw)
    with served(servos, folder / "bus") as where:
        ids = (*IDS, jaw.id) if jaw else IDS
        bus = ServoBus(where, KINDS[kind], ids, node["baud"], TIMEOUT, node["tries"])
        arm = Wired(servos, node, bus, driving)
        try:
            yield arm
        finally:
            arm.close()
