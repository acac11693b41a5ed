"""The paper's law of reaching, and its control without attractors (section II)."""

import math
from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.deciding import drawn_by
from imitation.dynamics import Dynamics, homeostatic, reaching, uniform_noise
from imitation.perception import Percept
from imitation.robot import Observation
from imitation.sample import Decision
from imitation.visuo_motor_map import VisuoMotorMap


def along_postures(scaled: Array) -> Array:
    """Shapes noise like the spread of learned postures (n, n_joints): (n_joints, n_joints).

    Its longest direction keeps the length of isotropic noise.
    """
    covariance = np.cov(scaled.T)
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0) / values.max()))


@dataclass
class Yuragi:
    """A = K d while the distance d shrinks, else 0; noise level epsilon_N d.

    Args:
        gain_per_px: K; 0 is the control without attractors [1/px].
        noise_per_px: epsilon_N [1/px].
        radius: Attractors of areas whose centre is nearer to the target take part [area sides].
        noise_steps: Noise is drawn anew after this many control steps; as printed at each. An arm
            of limited acceleration swallows noise that changes at once.
        noise_along_map: Noise is shaped like the spread of the learned postures; as printed it
            is isotropic in joint space, and leads off the sheet the postures lie on.
        distance_cap: d counts no more than this in A and the noise [px]; inf as printed.
        return_when_unseen: Without a hand in view the attractors alone act (A = 1, no noise);
            as printed the last distance stays.
        rng: Draws the noise.
    """

    gain_per_px: float
    noise_per_px: float
    radius: float
    noise_steps: int
    noise_along_map: bool
    distance_cap: float
    return_when_unseen: bool
    rng: np.random.Generator

    keeps_correcting = False

    def begin(self, learned: VisuoMotorMap, target: Array) -> None:
        """A new trial towards `target` (2,) [px]."""
        self._learned = learned
        self._selection = learned.field.within(target, self.radius * learned.field.side)
        self._distance = np.inf
        self._shape: Array | None = None
        self._steps = 0

    def decide(
        self, seen: Observation, percept: Percept, target: Array, dynamics: Dynamics
    ) -> Decision:
        """Where the arm is drawn now."""
        if self._steps % self.noise_steps == 0:
            self._unit = uniform_noise(self.rng, len(seen.posture), 1.0)
        self._steps += 1
        gain, level = self._strengths(percept, target)
        attractors = self._learned.attractors(self._selection, seen.posture)
        noise = level * (self._shaping(dynamics) @ self._unit)
        distance = float("nan") if percept.hand is None else self._distance
        return drawn_by(
            attractors,
            self._selection,
            seen.posture,
            dynamics,
            gain,
            level,
            noise,
            target=target,
            distance=distance,
        )

    def _strengths(self, percept: Percept, target: Array) -> tuple[float, float]:
        if percept.hand is None and self.return_when_unseen:
            return homeostatic()
        before = self._distance
        if percept.hand is not None:
            self._distance = math.dist(percept.hand, target)
        if not np.isfinite(self._distance):
            return homeostatic()  # the hand was never seen: there is no distance yet
        capped = min(self._distance, self.distance_cap)
        gain, level = reaching(self._distance, before, self.gain_per_px, self.noise_per_px)
        return gain * capped / max(self._distance, 1e-9), level * capped / max(self._distance, 1e-9)

    def _shaping(self, dynamics: Dynamics) -> Array:
        if self._shape is None:
            joints = len(dynamics.lower)
            postures, _ = self._learned.memories()
            along = self.noise_along_map and len(postures) > 2
            self._shape = along_postures(dynamics.scaled(postures)) if along else np.eye(joints)
        return self._shape
