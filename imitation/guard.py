"""The guard: what no command may make the arm do, whoever asks."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from imitation.arrays import Array
from imitation.dynamics import fastest_stoppable, ramped

REASONS = ("not a number", "speed", "acceleration", "joint limit", "surroundings")
ROUNDING = 1e-9  # what differs by less is the same [rad, rad/s]


class Surroundings(Protocol):
    """Knows how near the arm would be to what it must not touch."""

    def clearance(self, postures: Array) -> Array:
        """Smallest distance of the arm to all that (n,) [m], at `postures` (n, n_joints).

        Postures are in radians.
        """


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
        late: How long after it was sent a movement is done: so far the arm goes on from where it
            is sensed to be [s].
    """

    lower: Array
    upper: Array
    speed: Array
    acceleration: Array
    margin: float
    surroundings: Surroundings | None
    least_clearance: float
    late: float

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

    def opening_within_limits(self, wanted: float | None) -> float | None:
        """What is left of a wanted opening of the gripper [0..1]; None, as it is, for no number."""
        if wanted is None or np.isnan(wanted):
            return None
        return float(min(max(wanted, 0.0), 1.0))

    def limit(
        self, wanted: Array, before: Array, posture: Array, period: float
    ) -> tuple[Array, tuple[str, ...]]:
        """What is left of the velocity `wanted` [rad/s], and why.

        Args:
            wanted: Velocity asked for, (n_joints,) [rad/s].
            before: Velocity of the last period, (n_joints,) [rad/s].
            posture: Sensed posture, (n_joints,) [rad].
            period: Control period [s].
        """
        if not np.isfinite(posture).all():
            return self._braked(before, period), ("not a number",)
        posture = posture + before * self.late
        if not np.isfinite(wanted).all():
            return self._braked_clear(before, posture, period), ("not a number",)
        reasons: list[str] = []
        # All joints are slowed together, so that the arm keeps its direction.
        with np.errstate(over="ignore"):  # beyond all numbers is too fast as well
            excess = float((np.abs(wanted) / self.speed).max())
        velocity = wanted / max(excess, 1.0)
        if excess > 1.0 + 1e-9:
            reasons.append("speed")
        reachable = ramped(velocity, before, self.acceleration * period)
        if _differ(reachable, velocity):
            reasons.append("acceleration")
        stopping = self._able_to_stop_at_limits(reachable, posture, period)
        if _differ(stopping, reachable):
            reasons.append("joint limit")
        if self._too_near(stopping, posture, period):
            stopping = self._braked_clear(before, posture, period)
            reasons.append("surroundings")
        return stopping, tuple(reasons)

    def _braked(self, before: Array, period: float) -> Array:
        # Each joint as hard as it can: waiting for the slowest one would carry the others on.
        return np.sign(before) * np.maximum(np.abs(before) - self.acceleration * period, 0.0)

    def _able_to_stop_at_limits(self, velocity: Array, posture: Array, period: float) -> Array:
        room = np.array((posture - self.lower, self.upper - posture)) - self.margin
        down, up = fastest_stoppable(np.maximum(room, 0.0), self.acceleration, period)
        return np.asarray(np.minimum(np.maximum(velocity, -down), up))

    def _too_near(self, velocity: Array, posture: Array, period: float) -> bool:
        if self.surroundings is None:
            return False
        along = self._least_together(velocity, posture, period, self.margin)
        if along >= self.least_clearance:
            return False
        # From too near, the way out is open.
        enough = min(self.least_clearance, self._least(posture[None]))
        apart = self._least(self._each_to_rest(velocity, posture, period))
        return max(along, apart) < enough

    def _braked_clear(self, before: Array, posture: Array, period: float) -> Array:
        """Of the two ways to brake, the first step of the one that keeps more clearance."""
        each = self._braked(before, period)
        if self.surroundings is None:
            return each
        step = self.acceleration * period
        together = before * max(0.0, 1.0 - 1.0 / max(float(np.max(np.abs(before) / step)), 1.0))
        along = self._least_together(together, posture, period, self.margin)
        apart = self._least(self._each_to_rest(each, posture, period))
        if max(along, apart) < self.least_clearance:
            # An arm is not quite where it was led: half of the margin is there for that.
            along = self._least_together(together, posture, period, self.margin / 2)
        return together if along >= apart else each

    def _least_together(
        self, velocity: Array, posture: Array, period: float, margin: float
    ) -> float:
        way = self._together_to_rest(velocity, posture, period)
        # A joint that waits for the slowest may be carried beyond its own limit.
        lowest = np.minimum(self.lower + margin, posture) - ROUNDING
        highest = np.maximum(self.upper - margin, posture) + ROUNDING
        within = (lowest <= way[-1]) & (way[-1] <= highest)
        return self._least(way) if within.all() else -np.inf

    def _least(self, way: Array) -> float:
        assert self.surroundings is not None
        return float(self.surroundings.clearance(way).min())

    def _together_to_rest(self, velocity: Array, posture: Array, period: float) -> Array:
        """Postures of the coming periods when all joints brake in proportion, (n, n_joints)."""
        lasting = max(float((np.abs(velocity) / (self.acceleration * period)).max()), 1.0)
        share = np.maximum(1.0 - np.arange(np.ceil(lasting)) / lasting, 0.0)
        return np.asarray(posture + share.cumsum()[:, None] * velocity * period)

    def _each_to_rest(self, velocity: Array, posture: Array, period: float) -> Array:
        """The same when each joint brakes as hard as it can, one coming to rest after the other."""
        step = self.acceleration * period
        periods = np.arange(max(np.ceil(np.max(np.abs(velocity) / step)), 1))
        speeds = np.maximum(np.abs(velocity) - periods[:, None] * step, 0.0)
        return np.asarray(posture + np.cumsum(np.sign(velocity) * speeds, axis=0) * period)


def _differ(one: Array, other: Array) -> bool:
    return bool(np.abs(one - other).max() > ROUNDING)
