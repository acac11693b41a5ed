"""The guard: what no command may make the arm do, whoever asks."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from imitation.arrays import Array
from imitation.dynamics import fastest_stoppable


class Surroundings(Protocol):
    """Knows how near the arm would be to what it must not touch."""

    def clearance(self, posture: Array) -> float:
        """Smallest distance of the arm at `posture` [rad] to table and own body [m]."""


@dataclass(frozen=True)
class Guard:
    """Limits of joints, speed, acceleration and place.

    Args:
        lower: Lower joint limits, (n_joints,) [rad].
        upper: Upper joint limits, (n_joints,) [rad].
        speed: Largest speed of each joint, (n_joints,) [rad/s].
        acceleration: Largest acceleration of each joint, (n_joints,) [rad/s^2].
        margin: Kept from the joint limits [rad].
        surroundings: What must not be touched; None for an arm that stands free.
        least_clearance: Kept from the surroundings [m].
    """

    lower: Array
    upper: Array
    speed: Array
    acceleration: Array
    margin: float
    surroundings: Surroundings | None
    least_clearance: float

    def posture_within_limits(self, posture: Array) -> Array:
        """`posture` [rad] itself; refused when it lies beyond the joint limits."""
        if not np.isfinite(posture).all():
            raise ValueError("a start posture must be finite numbers [rad]")
        beyond = (posture < self.lower) | (posture > self.upper)
        if beyond.any():
            joint = int(np.argmax(beyond))
            raise ValueError(
                f"joint {joint + 1} of the start posture is {posture[joint]:.3f} rad, its limits "
                f"are {self.lower[joint]:.3f} to {self.upper[joint]:.3f}"
            )
        return posture

    def limit(
        self, wanted: Array, before: Array, posture: Array, period: float
    ) -> tuple[Array, tuple[str, ...]]:
        """What is left of the velocity `wanted` [rad/s], and why.

        Args:
            wanted: Velocity asked for, (n_joints,) [rad/s].
            before: Velocity of the last period, (n_joints,) [rad/s].
            posture: Present posture, (n_joints,) [rad].
            period: Control period [s].
        """
        reasons: list[str] = []
        if not np.isfinite(wanted).all():
            wanted = np.zeros_like(before)
            reasons.append("not a number")
        # All joints are slowed together, so that the arm keeps its direction.
        excess = float(np.max(np.abs(wanted) / self.speed))
        velocity = wanted / max(excess, 1.0)
        if excess > 1.0 + 1e-9:
            reasons.append("speed")
        ramped = self._ramped(velocity, before, period)
        if not np.allclose(ramped, velocity, rtol=0, atol=1e-9):
            reasons.append("acceleration")
        stopping = self._able_to_stop_at_limits(ramped, posture, period)
        if not np.allclose(stopping, ramped, rtol=0, atol=1e-9):
            reasons.append("joint limit")
        if self._too_near(stopping, posture, period):
            stopping = self._ramped(np.zeros_like(before), before, period)
            reasons.append("surroundings")
        return stopping, tuple(reasons)

    def _ramped(self, velocity: Array, before: Array, period: float) -> Array:
        change = self.acceleration * period
        return np.clip(velocity, before - change, before + change)

    def _able_to_stop_at_limits(self, velocity: Array, posture: Array, period: float) -> Array:
        up = np.maximum(self.upper - posture - self.margin, 0.0)
        down = np.maximum(posture - self.lower - self.margin, 0.0)
        return np.clip(
            velocity,
            -fastest_stoppable(down, self.acceleration, period),
            fastest_stoppable(up, self.acceleration, period),
        )

    def _too_near(self, velocity: Array, posture: Array, period: float) -> bool:
        if self.surroundings is None:
            return False
        # Where the arm stands when it brakes after this period.
        braking = velocity * np.abs(velocity) / (2 * self.acceleration)
        stop = np.clip(posture + velocity * period + braking, self.lower, self.upper)
        after = self.surroundings.clearance(stop)
        return after < self.least_clearance and after < self.surroundings.clearance(posture)
