"""Two fingers in the PyBullet world, and what they and the palm feel of a can."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.robots.bullet.silence import silence

with silence():
    import pybullet


@dataclass(frozen=True)
class Fingers:
    """A gripper of two fingers that turn together.

    Args:
        joints: Names of the two joints, closing with the negative sense.
        force: Largest torque of a finger [Nm].
        speed: Largest speed of a finger [rad/s].
        friction: Of the pads, lateral, without unit.
        spinning: Of the pads, against a can turning about the line between them [m].
        rolling: Of the pads, against rolling [m].
        palm: Link of the URDF that the fingers sit on.
        rays: Where the palm's rays begin in that link, (n, 3) [m].
        reach: How far they see, along the link's x [m].
        beams: How far out along a finger's x each beam between the pads is [m].
        pad: Where a pad's inner face begins: how far out along the finger's x, and how far beside
            that axis [m].
    """

    joints: tuple[str, ...]
    force: float
    speed: float
    friction: float
    spinning: float
    rolling: float
    palm: str
    rays: tuple[tuple[float, float, float], ...]
    reach: float
    beams: tuple[float, ...]
    pad: tuple[float, float]


class Gripper:
    """The fingers of one arm in a world that was just built.

    Args:
        fingers: What they are.
        arm: Number of the arm in the engine.
        joints: Numbers of the engine's joints (and links that they move), by name.
        links: Numbers of the links, by name.
        client: The engine.
    """

    def __init__(
        self,
        fingers: Fingers,
        arm: int,
        joints: Mapping[str, int],
        links: Mapping[str, int],
        client: int,
    ) -> None:
        self._fingers, self._arm, self._client = fingers, arm, client
        self._joints = [joints[name] for name in fingers.joints]
        self._palm = links[fingers.palm]
        info = [pybullet.getJointInfo(arm, one, physicsClientId=client) for one in self._joints]
        self._range = [(row[8], row[9]) for row in info]

    def place(self, opening: float) -> None:
        """Put the fingers at rest at `opening` (0 closed .. 1 open)."""
        for joint, angle in zip(self._joints, self._angles(opening), strict=True):
            pybullet.resetJointState(self._arm, joint, angle, physicsClientId=self._client)

    def grip(self, opening: float) -> None:
        """Let the fingers move to `opening` (0 closed .. 1 open)."""
        for joint, angle in zip(self._joints, self._angles(opening), strict=True):
            pybullet.setJointMotorControl2(
                self._arm,
                joint,
                pybullet.POSITION_CONTROL,
                targetPosition=angle,
                force=self._fingers.force,
                maxVelocity=self._fingers.speed,
                physicsClientId=self._client,
            )

    def keep_within_stops(self) -> None:
        """Put back a finger that was forced beyond its range."""
        # The engine lets an arm that presses on something bend a joint's limit by a whole range.
        states = pybullet.getJointStates(self._arm, self._joints, physicsClientId=self._client)
        for joint, state, (closed, opened) in zip(self._joints, states, self._range, strict=True):
            angle = state[0]
            kept = min(max(angle, closed), opened)
            if kept != angle:
                pybullet.resetJointState(self._arm, joint, kept, physicsClientId=self._client)

    def opening(self) -> float:
        """How far it is open, 0 closed .. 1 open."""
        angle = pybullet.getJointState(self._arm, self._joints[0], physicsClientId=self._client)[0]
        closed, opened = self._range[0]
        return float((angle - closed) / (opened - closed))

    def prepare(self) -> None:
        """Gear the fingers together and give their pads friction, before there is a can."""
        one, other = self._joints
        gear = pybullet.createConstraint(
            self._arm,
            one,
            self._arm,
            other,
            pybullet.JOINT_GEAR,
            (0, 0, 1),
            (0, 0, 0),
            (0, 0, 0),
            physicsClientId=self._client,
        )
        # Without erp the gear keeps speeds alone, and the can drifts sideways with both fingers.
        pybullet.changeConstraint(
            gear,
            gearRatio=-1,
            maxForce=1000,
            erp=0.2,
            relativePositionTarget=0.0,
            physicsClientId=self._client,
        )
        for joint in self._joints:
            pybullet.changeDynamics(
                self._arm,
                joint,
                lateralFriction=self._fingers.friction,
                spinningFriction=self._fingers.spinning,
                rollingFriction=self._fingers.rolling,
                physicsClientId=self._client,
            )

    def touches(self, can: int) -> bool:
        """Whether the pads of both fingers touch `can`."""
        return all(self._pad_touches(joint, can) for joint in self._joints)

    def proximity(self, can: int) -> float:
        """From the palm to `can` when it is between the pads [m]; inf: it is not."""
        if not self._between(can):
            return float("inf")
        palm = self._frame(self._palm)
        starts = np.array(self._fingers.rays)
        ends = starts + np.array((self._fingers.reach, 0.0, 0.0))
        far = [hit for hit in self._rays(can, palm(starts), palm(ends)) if hit is not None]
        return min(far, default=1.0) * self._fingers.reach

    def _pad_touches(self, finger: int, can: int) -> bool:
        points = pybullet.getContactPoints(
            self._arm, can, linkIndexA=finger, physicsClientId=self._client
        )
        if not points:
            return False
        there = self._frame(finger).inside(np.array([point[5] for point in points]))
        return bool((there[:, 0] > self._fingers.pad[0]).any())

    def _between(self, can: int) -> bool:
        """Whether `can` breaks a beam between the inner faces of the pads."""
        out = self._fingers.beams
        inner = np.array([(x, self._fingers.pad[1], 0.0) for x in out])
        right, left = (self._frame(joint)(inner) for joint in self._joints)
        return any(hit is not None for hit in self._rays(can, right, left))

    def _rays(self, can: int, starts: Array, ends: Array) -> list[float | None]:
        """After which share of its way each ray meets `can`; None: it does not."""
        hits = pybullet.rayTestBatch(starts.tolist(), ends.tolist(), physicsClientId=self._client)
        return [hit[2] if hit[0] == can else None for hit in hits]

    def _frame(self, link: int) -> "Frame":
        state = pybullet.getLinkState(
            self._arm, link, computeForwardKinematics=1, physicsClientId=self._client
        )
        turn = np.array(pybullet.getMatrixFromQuaternion(state[5])).reshape(3, 3)
        return Frame(turn, np.array(state[4]))

    def _angles(self, opening: float) -> Sequence[float]:
        return [closed + opening * (opened - closed) for closed, opened in self._range]


@dataclass(frozen=True)
class Frame:
    """Where a link is."""

    turn: Array  # (3, 3)
    origin: Array  # (3,) [m]

    def __call__(self, points: Array) -> Array:
        """Its `points` (n, 3) in the world, (n, 3) [m]."""
        return np.asarray(points @ self.turn.T + self.origin)

    def inside(self, points: Array) -> Array:
        """The world's `points` (n, 3) [m] in this frame, (n, 3) [m]."""
        return np.asarray((points - self.origin) @ self.turn)
