"""Attractor dynamics of the arm in joint space: eqs. 1 and 2 of the paper."""

from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array


def activation(x: Array, attractors: Array, weights: Array, beta: float, power: int = 2) -> Array:
    """Each attractor's normalised weight N V in eq. 2, (n,); they sum to 1, or n = 0.

    Args:
        x: Posture, (n_joints,), each joint scaled to [-1, 1] by its limits.
        attractors: Learned postures, (n, n_joints), scaled likewise.
        weights: Visual weight V of each attractor, (n,), above 0.
        beta: Slope of the attraction basins, without unit.
        power: Exponent of the distance in the Gaussian: 2, or 4 as the text reads literally.
    """
    if not len(attractors):
        return np.zeros(0)
    squared = ((attractors - x) ** 2).sum(axis=1)
    exponent = np.log(weights) - beta * squared ** (power / 2)
    # Shifting cancels in the ratio and keeps far attractors from underflowing to 0/0.
    basin = np.exp(exponent - exponent.max())
    return np.asarray(basin / basin.sum())


def attraction(x: Array, attractors: Array, weights: Array, beta: float, power: int = 2) -> Array:
    """Pull f(x) of the weighted attractors on posture `x` (eq. 2), (n_joints,) [-1..1].

    Attractors whose weight is not above 0 take no part; when none is left there is no pull.
    """
    taking_part = weights > 0
    attractors, weights = attractors[taking_part], weights[taking_part]
    return np.asarray(activation(x, attractors, weights, beta, power) @ (attractors - x))


def uniform_noise(rng: np.random.Generator, joints: int, level: float) -> Array:
    """Noise term of eq. 1 as in the paper: uniform in [-level, level], anew at each step."""
    return np.asarray(level * rng.uniform(-1.0, 1.0, joints))


def diffusion_noise(rng: np.random.Generator, joints: int, sigma: float, h: float) -> Array:
    """Noise term of eq. 1 that moves x by sigma sqrt(h) N(0, 1) at each step of h = dt / tau.

    Its effect does not change with the step (Euler-Maruyama), unlike that of uniform noise.
    """
    return np.asarray(sigma / np.sqrt(h) * rng.standard_normal(joints))


@dataclass(frozen=True)
class Pull:
    """What eq. 2 makes of the attractors that take part."""

    activation: Array  # normalised weight N V of each attractor, (n,)
    shares: Array  # each attractor's share of f(x), (n, n_joints) [-1..1]


@dataclass(frozen=True)
class Dynamics:
    """Eqs. 1 and 2 for one arm, between postures [rad] and joints scaled to [-1, 1].

    Args:
        lower: Lower joint limits, (n_joints,) [rad].
        upper: Upper joint limits, (n_joints,) [rad].
        tau: Time constant of the arm [s].
        beta: Slope of the attraction basins, without unit.
        kernel_power: Exponent of the distance in the Gaussian, 2 or 4.
    """

    lower: Array
    upper: Array
    tau: float
    beta: float
    kernel_power: int = 2

    def scaled(self, posture: Array) -> Array:
        """Postures [rad] with each joint scaled to [-1, 1] by its limits."""
        return (2 * posture - self.upper - self.lower) / (self.upper - self.lower)

    def unscaled(self, x: Array) -> Array:
        """Postures [rad] from joints scaled to [-1, 1]."""
        return (x * (self.upper - self.lower) + self.upper + self.lower) / 2

    def pull(self, posture: Array, attractors: Array, weights: Array) -> Pull:
        """Activation and share of f(x) (eq. 2) of `attractors` (n, n_joints) [rad]."""
        x, scaled = self.scaled(posture), self.scaled(attractors)
        share = activation(x, scaled, weights, self.beta, self.kernel_power)
        return Pull(share, share[:, None] * (scaled - x))

    def velocity(self, pull: Pull, gain: float, noise: Array) -> Array:
        """Joint velocity (eq. 1), (n_joints,) [rad/s]: still when no attractor takes part.

        Args:
            pull: Shares of f(x), from `pull`.
            gain: A, without unit.
            noise: Noise term, (n_joints,) [-1..1], scaled by the noise level already.
        """
        if not len(pull.activation):
            return np.zeros_like(noise)
        scaled_velocity = (gain * pull.shares.sum(axis=0) + noise) / self.tau
        return np.asarray(scaled_velocity * (self.upper - self.lower) / 2)


def homeostatic() -> tuple[float, float]:
    """Gain A and noise level of the homeostatic controller (section III)."""
    return 1.0, 0.0


def reaching(
    distance: float, distance_before: float, gain_per_px: float, noise_per_px: float
) -> tuple[float, float]:
    """Gain A and noise level while reaching (section II).

    A = K d while the distance shrinks, else 0; the noise level is epsilon_N d.

    Args:
        distance: From the seen hand to the target, d [px].
        distance_before: The same one step ago [px].
        gain_per_px: K [1/px].
        noise_per_px: epsilon_N [1/px].
    """
    gain = gain_per_px * distance if distance < distance_before else 0.0
    return gain, noise_per_px * distance


def fastest_stoppable(room: Array, acceleration: Array, period: float) -> Array:
    """Largest speed (n_joints,) [rad/s] that, braked from the next period on, ends within `room`.

    Args:
        room: Distance left to each joint, (n_joints,) [rad], not below 0.
        acceleration: What each joint can brake with, (n_joints,) [rad/s^2].
        period: How long a velocity lasts before it can be changed [s].
    """
    step = acceleration * period
    # Braking takes whole periods: n full steps of speed cover n (n + 1) / 2 of step * period.
    periods = np.floor(np.sqrt(0.25 + 2 * room / (step * period)) - 0.5)
    return np.asarray(step * periods / 2 + room / ((periods + 1) * period))


def ramped(velocity: Array, before: Array, step: Array) -> Array:
    """The velocity (n_joints,) [rad/s] next to `velocity` that `before` can become in one period.

    All joints change together, so that a movement from rest keeps to its line.

    Args:
        velocity: Wanted.
        before: Velocity of the last period, (n_joints,) [rad/s].
        step: What each joint can change by in a period, (n_joints,) [rad/s], above 0.
    """
    change = np.abs(velocity - before) / step
    return np.asarray(before + (velocity - before) / max(float(change.max(initial=0.0)), 1.0))


def able_to_stop(velocity: Array, to_go: Array, acceleration: Array, period: float) -> Array:
    """`velocity` (n_joints,) [rad/s] slowed, along its line, so that no joint overshoots.

    Args:
        velocity: Wanted, towards where the movement is to end.
        to_go: Joint distance to there, (n_joints,) [rad].
        acceleration: What each joint can brake with, (n_joints,) [rad/s^2].
        period: How long a velocity lasts before it can be changed [s].
    """
    allowed = fastest_stoppable(np.abs(to_go), acceleration, period)
    excess = float((np.abs(velocity) / np.maximum(allowed, 1e-12)).max(initial=0.0))
    return np.asarray(velocity / max(excess, 1.0))
