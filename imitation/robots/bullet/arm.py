"""An arm in the PyBullet world, driven by joint velocities."""

import numpy as np

from imitation.arrays import Array
from imitation.robot import Body, JointReading
from imitation.robots.bullet.photograph import BulletScene
from imitation.robots.bullet.world import World


class BulletArm:
    """A simulated arm: motors that run at the commanded velocity and hold when it is 0.

    Args:
        world: Where the arm stands.
        body: Its joints and limits.
        stiffness: How fast the arm is pulled back to where its commands should have brought it
            [1/s]; the motors of the engine give way to gravity without it.
    """

    live = False

    def __init__(self, world: World, body: Body, stiffness: float) -> None:
        self.world, self.body, self._stiffness = world, body, stiffness
        self.scene = BulletScene(world)
        self._expected = np.zeros(len(body.lower))  # where the commands lead [rad]
        self._posture = self._velocity = self._expected  # as the joints are [rad], [rad/s]
        self._mark = np.zeros(3)  # where the hand's mark is [m]

    def reset(self, posture: Array) -> None:
        """Be at rest at `posture` [rad] in a rebuilt world."""
        self._expected = posture.copy()
        self.world.rebuild(posture, opening=1.0)
        self.world.hold(posture)
        self._sense()

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """Move with `velocity` [rad/s] for `period` [s]."""
        substeps = round(period * self.world.rate)
        if not velocity.any():
            self.world.hold(self._expected)
        else:
            self.world.drive(velocity + self._stiffness * (self._expected - self._posture))
        if grip is not None:
            self.world.grip(grip)
        self.world.advance(substeps)
        self._expected = self._expected + velocity * period
        self._sense()
        return velocity

    def read(self) -> JointReading:
        """Sense the joints and the gripper."""
        felt = self.world.opening(), self.world.proximity(), self.world.touching()
        return JointReading(self._posture, self._velocity, *felt)

    def truth(self) -> tuple[Array, Array | None]:
        """True position of the hand's mark [m] and pose of the can."""
        return self._mark, self.world.can_pose()

    def close(self) -> None:
        """End the world."""
        self.world.close()

    def _sense(self) -> None:
        self._posture, self._velocity = self.world.joint_state()
        self._mark = self.world.carry_mark()
