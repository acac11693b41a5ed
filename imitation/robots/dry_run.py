"""An arm that is asked but never told: everything is done but for moving it."""

from dataclasses import replace

from imitation.arrays import Array
from imitation.robot import Arm, Body, JointReading


class DryRun:
    """Stands before an arm: lets it be read, and imagines where its commands would lead it.

    Args:
        arm: What is not moved.
    """

    def __init__(self, arm: Arm) -> None:
        self._arm, self.live = arm, arm.live
        self.body: Body = arm.body
        self.scene = getattr(arm, "scene", None)  # of a simulated arm, which stays as it is
        self._imagined: JointReading | None = None

    def reset(self, posture: Array) -> None:
        """Imagine being at rest at `posture` [rad]; a simulated arm is put there."""
        if not self.live:
            self._arm.reset(posture)
        self._imagined = replace(self._arm.read(), posture=posture, velocity=0 * posture)

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        """Imagine having moved; nothing is sent, so the velocity sent is 0."""
        before = self.read()
        self._imagined = replace(
            before, posture=before.posture + velocity * period, velocity=velocity
        )
        return 0 * velocity

    def read(self) -> JointReading:
        """Where the arm would be; before any command, where it is."""
        return self._imagined or self._arm.read()

    def truth(self) -> tuple[Array, Array | None] | None:
        """The arm's own truth: it has not moved."""
        return self._arm.truth()

    def close(self) -> None:
        """Release the arm; harmless when repeated."""
        self._arm.close()
