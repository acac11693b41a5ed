"""Simulated arms that fail for a while, and are watched then as a real one always is."""

from dataclasses import replace

import numpy as np

from imitation.arrays import Array
from imitation.device import DeviceError
from imitation.robot import Arm, Body, JointReading
from imitation.robots.faults import lasting
from imitation.robots.keeping_up import KeepingUp

# What a motor's controller tells.
TROUBLE = {
    "crashed_motor": "has collided (status 40): free the arm",
    "hot_motor": "tells of its temperature: let it cool, and see what holds it",
    "overloaded_motor": "tells of its overload: see what holds it",
}


class FaultyArm:
    """Stands before an arm and counts its time.

    Args:
        arm: What is spoilt.
        name: Of the fault.
        at: It begins so long after the run did [s].
        lasts: For so long [s]; None: until the end.
    """

    def __init__(self, arm: Arm, name: str, at: float, lasts: float | None) -> None:
        self._arm, self._fault = arm, lasting(name, at, lasts)
        self.body: Body = arm.body
        self.live, self.scene = arm.live, getattr(arm, "scene", None)
        self._now = 0.0  # [s]

    def reset(self, posture: Array) -> None:
        """Be at rest at `posture` [rad]."""
        self._arm.reset(posture)

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """Move with `velocity` [rad/s] for `period` [s]; returns the velocity that was sent."""
        self._now += period
        return self._arm.move(velocity, grip, period)

    def read(self) -> JointReading:
        """Sense the joints and the gripper."""
        return self._arm.read()

    def truth(self) -> tuple[Array, Array | None] | None:
        """True position of the hand's mark and pose of the object."""
        return self._arm.truth()

    def close(self) -> None:
        """Stop the arm and release it; harmless when repeated."""
        self._arm.close()

    @property
    def _fails(self) -> bool:
        return self._fault.lasts(self._now)


class SilentArm(FaultyArm):
    """An arm that does not answer."""

    def read(self) -> JointReading:
        """The same; it is an error while the arm is silent."""
        if self._fails:
            raise DeviceError("the arm does not answer: see to its power and cable")
        return super().read()


class FaultyMotor(FaultyArm):
    """An arm one of whose motors fails.

    Args:
        arm: What is spoilt.
        name: Of the fault.
        at: It begins so long after the run did [s].
        lasts: For so long [s]; None: until the end.
        joint: The motor's, from 1.
    """

    def __init__(self, arm: Arm, name: str, at: float, lasts: float | None, joint: int) -> None:
        super().__init__(arm, name, at, lasts)
        if joint > len(arm.body.joint_names):
            raise ValueError(
                f"fault.joint={joint}: {arm.body.name} has joints 1 to {len(arm.body.joint_names)}"
            )
        self._number = joint - 1


class ArmInTrouble(FaultyMotor):
    """An arm one of whose motors says that it can do no more."""

    def read(self) -> JointReading:
        """The same; it is an error while a motor is in trouble."""
        if self._fails:
            told = TROUBLE[self._fault.name]
            raise DeviceError(f"{self.body.joint_names[self._number]} {told}")
        return super().read()


class StuckArm(FaultyMotor):
    """An arm with a joint that does not move, or whose angle is sensed as it was.

    Args:
        arm: What is spoilt.
        name: Of the fault.
        at: It begins so long after the run did [s].
        lasts: For so long [s]; None: until the end.
        joint: Which, from 1.
        following: How far a joint may be from where it was sent [rad].
        overdue: For how long it may be [s].
    """

    def __init__(
        self,
        arm: Arm,
        name: str,
        at: float,
        lasts: float | None,
        joint: int,
        following: float,
        overdue: float,
    ) -> None:
        super().__init__(arm, name, at, lasts, joint)
        self._keeping_up = KeepingUp(arm.body.joint_names, following, overdue)
        self._sent = self._sound = np.zeros(len(arm.body.lower))  # [rad]

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """The same; what is sent keeps within the joints' limits, whatever is sensed."""
        target = np.clip(self._sent + velocity * period, self.body.lower, self.body.upper)
        going, self._sent = (target - self._sent) / period, target
        if self._fails and self._fault.name == "stuck_motor":
            going[self._number] = 0.0
        return super().move(going, grip, period)

    def read(self) -> JointReading:
        """The same, or how it was; it is an error while a joint stays behind for too long."""
        reading = self._arm.read()
        if not self._fails:
            self._sent = self._sound = reading.posture
            return reading
        if self._fault.name == "stuck_encoder":
            posture, velocity = reading.posture.copy(), reading.velocity.copy()
            posture[self._number], velocity[self._number] = self._sound[self._number], 0.0
            reading = replace(reading, posture=posture, velocity=velocity)
        self._keeping_up.check(np.abs(reading.posture - self._sent), self._now)
        return reading
