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
        behind: How far an arm that is blocked falls behind where its commands lead [rad]; it has
            no more than that to make up for when it is free again.
    """

    live = False

    def __init__(self, world: World, body: Body, stiffness: float, behind: float) -> None:
        self.world, self.body = world, body
        self._stiffness, self._behind = stiffness, behind
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
            returning = self._stiffness * (self._expected - self._posture)
            self.world.drive(np.clip(velocity + returning, -self.body.speed, self.body.speed))
        if grip is not None:
            self.world.grip(grip)
        self.world.advance(substeps)
        self._sense()
        lead = self._expected + velocity * period
        self._expected = np.clip(lead, self._posture - self._behind, self._posture + self._behind)
        return velocity

    @property
    def led_to(self) -> Array:
        """Where its commands lead, less what it will not make up for, (n_joints,) [rad]."""
        return self._expected

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
