"""A PyBullet world: table, arm and what stands before it. The one module that knows the engine."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from imitation.arrays import Array, Image
from imitation.robots.bullet.silence import silence
from imitation.robots.bullet.world_can import Can, StandingCan
from imitation.robots.bullet.world_gripper import Fingers, Gripper
from imitation.robots.bullet.world_picture import FLAT_LIGHT, Backdrop, rendered
from imitation.robots.bullet.world_table import Table, add_solid

with silence():
    import pybullet
    import pybullet_data

OUT_OF_SIGHT = np.array((0.0, 0.0, -1.0))  # below the table [m]


def find_urdf(name: str) -> Path:
    """A URDF by its name: one of ours, one of pybullet_data's, or a path."""
    ours, theirs = Path(__file__).parent / name, Path(pybullet_data.getDataPath()) / name
    for path in (Path(name), ours, theirs):
        if path.is_file():
            return path
    raise ValueError(f"no URDF file {name}: give a path, or a name below pybullet_data")


@dataclass(frozen=True)
class Mark:
    """A coloured sphere on the hand that the camera sees."""

    link: str  # link of the URDF that carries it
    offset: tuple[float, float, float]  # its centre in that link [m]
    radius: float  # [m]
    colour: tuple[float, float, float, float]  # red, green, blue, opacity [0..1]


@dataclass
class World:
    """One arm over one table in an engine of its own.

    Args:
        urdf: Name or path of the arm's URDF.
        joints: Names of the arm's joints, in the order of a posture.
        fingers: Of its gripper; None: it has none.
        mark: What the camera sees of the hand.
        table: What the arm works on.
        base: Where the arm stands (3,) [m].
        rate: Physics steps per second [Hz].
        iterations: Of the contact solver, for each physics step.
        force: Largest motor torque of each joint [Nm].
        can: What stands on the table; None: nothing.
    """

    urdf: str
    joints: tuple[str, ...]
    fingers: Fingers | None
    mark: Mark
    table: Table
    base: tuple[float, float, float]
    rate: int
    iterations: int
    force: tuple[float, ...]
    can: Can | None = None
    _links: dict[str, int] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        if not pybullet.isNumpyEnabled():
            raise RuntimeError(
                "this PyBullet was built without numpy; install its wheel for Python 3.11"
            )
        self.path = find_urdf(self.urdf)
        self._client = pybullet.connect(pybullet.DIRECT)
        self._backdrop = Backdrop(self.table)

    def rebuild(self, posture: Array, opening: float) -> None:
        """A new world with the arm at rest at `posture` [rad], the same down to the last bit."""
        call: dict[str, Any] = {"physicsClientId": self._client}
        pybullet.resetSimulation(**call)
        pybullet.setGravity(0, 0, -9.81, **call)
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=1 / self.rate,
            numSolverIterations=self.iterations,
            deterministicOverlappingPairs=1,
            **call,
        )
        self._add_table()
        self._arm = pybullet.loadURDF(str(self.path), self.base, useFixedBase=True, **call)
        count = pybullet.getNumJoints(self._arm, **call)
        info = [pybullet.getJointInfo(self._arm, joint, **call) for joint in range(count)]
        by_name = {row[1].decode(): joint for joint, row in enumerate(info)}
        self._links = {row[12].decode(): joint for joint, row in enumerate(info)}
        self._joints = [self._known(name, by_name) for name in self.joints]
        self._known(self.mark.link, self._links)
        for joint, angle in zip(self._joints, posture, strict=True):
            pybullet.resetJointState(self._arm, joint, angle, **call)
        self._gripper = self._add_gripper(by_name)
        if self._gripper:
            self._gripper.place(opening)
        driven = {*self.joints, *(self.fingers.joints if self.fingers else ())}
        self._hold([row for row in info if row[1].decode() not in driven])
        self._mark = self._sphere(self.mark.radius, self.mark.colour)
        self._covered = False
        self.carry_mark()
        self._other: int | None = None
        self._can = StandingCan(self.can, self._client) if self.can else None
        self.grip(opening)

    def drive(self, velocity: Array) -> None:
        """Let the joint motors run with `velocity` [rad/s]."""
        pybullet.setJointMotorControlArray(
            self._arm,
            self._joints,
            pybullet.VELOCITY_CONTROL,
            targetVelocities=velocity.tolist(),
            forces=self.force,
            physicsClientId=self._client,
        )

    def hold(self, posture: Array) -> None:
        """Let the joint motors hold `posture` [rad]."""
        pybullet.setJointMotorControlArray(
            self._arm,
            self._joints,
            pybullet.POSITION_CONTROL,
            targetPositions=posture.tolist(),
            forces=self.force,
            physicsClientId=self._client,
        )

    def grip(self, opening: float) -> None:
        """Let the fingers move to `opening` (0 closed .. 1 open)."""
        if self._gripper:
            self._gripper.grip(opening)

    def advance(self, substeps: int) -> None:
        """Let `substeps` physics steps pass."""
        for _ in range(substeps):
            pybullet.stepSimulation(physicsClientId=self._client)
            if self._gripper and self._can:
                self._gripper.keep_within_stops()

    def joint_state(self) -> tuple[Array, Array]:
        """Posture [rad] and velocity [rad/s] of the arm's joints."""
        states = pybullet.getJointStates(self._arm, self._joints, physicsClientId=self._client)
        return np.array([row[0] for row in states]), np.array([row[1] for row in states])

    def opening(self) -> float:
        """How far the gripper is open, 0 closed .. 1 open."""
        return self._gripper.opening() if self._gripper else 1.0

    def proximity(self) -> float:
        """From the palm to what is between the fingers [m]; inf: nothing is."""
        if not (self._gripper and self._can):
            return float("inf")
        return self._gripper.proximity(self._can.body)

    def touching(self) -> bool:
        """Whether both fingers touch something."""
        if not (self._gripper and self._can):
            return False
        return self._gripper.touches(self._can.body)

    def can_pose(self) -> Array | None:
        """Position [m] and quaternion of the can, (7,); None: there is none."""
        return self._can.pose() if self._can else None

    def mark_position(self) -> Array:
        """Centre of the mark on the hand, (3,) [m]."""
        state = pybullet.getLinkState(
            self._arm,
            self._links[self.mark.link],
            computeForwardKinematics=1,
            physicsClientId=self._client,
        )
        position, _ = pybullet.multiplyTransforms(
            state[4], state[5], self.mark.offset, (0, 0, 0, 1)
        )
        return np.array(position)

    def carry_mark(self) -> Array:
        """Put the mark where the hand is; returns its centre, (3,) [m]."""
        position = self.mark_position()
        self._put(self._mark, OUT_OF_SIGHT if self._covered else position)
        return position

    def cover_mark(self, covered: bool) -> None:
        """Take the mark out of sight, or have it on the hand again."""
        if covered != self._covered:
            self._covered = covered
            self.carry_mark()

    def show_other(self, position: Array | None, radius: float, colour: Sequence[float]) -> None:
        """Put the mark on another's hand at `position` (3,) [m]; None: it is not in sight."""
        if position is None:
            if self._other is not None:
                pybullet.removeBody(self._other, physicsClientId=self._client)
            self._other = None
            return
        if self._other is None:
            self._other = self._sphere(radius, colour)
        self._put(self._other, position)

    def carry_can(self, hand: Array | None) -> None:
        """Let the can follow another's `hand` (3,) [m]; None: it stands for itself."""
        if self._can:
            self._can.follow(hand)

    def render(self, view: Array, projection: Array, size: tuple[int, int]) -> Image:
        """A picture of the world, RGB, (height, width, 3)."""
        picture = rendered(self._client, view, projection, size, FLAT_LIGHT)
        return self._backdrop.behind(picture, view, projection)

    def close(self) -> None:
        """End the engine; harmless when repeated."""
        if pybullet.isConnected(self._client):
            pybullet.disconnect(self._client)

    def _known(self, name: str, numbers: Mapping[str, int]) -> int:
        """The number of a joint or link of the URDF, by its name."""
        if name not in numbers:
            raise ValueError(f"{self.urdf} has no {name}; it has {', '.join(numbers)}")
        return numbers[name]

    def _add_table(self) -> None:
        add_solid(self.table, self._client)

    def _add_gripper(self, joints: Mapping[str, int]) -> Gripper | None:
        if self.fingers is None:
            return None
        for name in self.fingers.joints:
            self._known(name, joints)
        self._known(self.fingers.palm, self._links)
        gripper = Gripper(self.fingers, self._arm, joints, self._links, self._client)
        if self.can:
            gripper.prepare()
        return gripper

    def _hold(self, others: Sequence[Sequence[Any]]) -> None:
        """Keep joints that nothing drives, such as a single jaw, where they are."""
        for row in others:
            if row[2] != pybullet.JOINT_FIXED:
                pybullet.setJointMotorControl2(
                    self._arm,
                    row[0],
                    pybullet.POSITION_CONTROL,
                    targetPosition=0.0,
                    force=row[10],
                    physicsClientId=self._client,
                )

    def _sphere(self, radius: float, colour: Sequence[float]) -> int:
        """A new sphere that is only seen, never touched."""
        call = {"physicsClientId": self._client}
        shape = pybullet.createVisualShape(
            pybullet.GEOM_SPHERE, radius=radius, rgbaColor=colour, **call
        )
        body: int = pybullet.createMultiBody(0.0, -1, shape, (0, 0, 0), **call)
        return body

    def _put(self, body: int, position: Array) -> None:
        pybullet.resetBasePositionAndOrientation(
            body, position.tolist(), (0, 0, 0, 1), physicsClientId=self._client
        )
