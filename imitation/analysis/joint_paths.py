"""Eq. 1 alone: paths of an arm of joints without a body among random attractors."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from imitation.arrays import Array
from imitation.dynamics import activation, attraction, uniform_noise

Order = NDArray[np.int64]  # attractor visited last at each posture of a path; -1: none yet
AT_REST = 1e-9  # a path without noise that is slower than this stays where it is [-1..1]


@dataclass(frozen=True)
class Simulation:
    """An arm of joints alone, each scaled to [-1, 1], among random attractors."""

    joints: int
    attractors: int
    beta: float  # slope of the attraction basins
    gain: float  # A
    step: float  # h = dt / tau

    def random_postures(self, rng: np.random.Generator, n: int) -> Array:
        """Postures anywhere in joint space, (n, joints)."""
        return rng.uniform(-1.0, 1.0, (n, self.joints))

    def pull(self, x: Array, attractors: Array) -> Array:
        """f(x) of equally weighted attractors (eq. 2), (joints,)."""
        return attraction(x, attractors, np.ones(len(attractors)), self.beta)

    def path(
        self,
        start: Array,
        attractors: Array,
        iterations: int,
        noise_level: float,
        rng: np.random.Generator,
    ) -> Array:
        """Postures of eq. 1 from `start`, (iterations + 1, joints); joint limits stop the arm."""
        path = np.empty((iterations + 1, self.joints))
        path[0] = start
        for i in range(iterations):
            noise = uniform_noise(rng, self.joints, noise_level)
            speed = self.gain * self.pull(path[i], attractors) + noise
            if not noise_level and np.abs(speed).max() < AT_REST:
                path[i + 1 :] = path[i]
                break
            path[i + 1] = np.clip(path[i] + self.step * speed, -1.0, 1.0)
        return path


@dataclass(frozen=True)
class End:
    """Where a path without noise ended."""

    speed: float  # |f| there [-1..1]
    distance: float  # to the attractor nearest to it [-1..1]
    at_nearest: bool  # that is the attractor nearest to the start


def end_of(path: Array, attractors: Array, simulation: Simulation) -> End:
    """Where `path` (n, joints) ended among `attractors`."""
    before = np.linalg.norm(attractors - path[0], axis=1)
    after = np.linalg.norm(attractors - path[-1], axis=1)
    speed = float(np.linalg.norm(simulation.pull(path[-1], attractors)))
    return End(speed, float(after.min()), bool(before.argmin() == after.argmin()))


def visits(path: Array, attractors: Array, beta: float, visited: float) -> Order:
    """Attractor visited last at each posture of `path` (n, joints), (n,); -1 before the first."""
    last, order = -1, np.empty(len(path), dtype=np.int64)
    for i, x in enumerate(path):
        share = activation(x, attractors, np.ones(len(attractors)), beta)
        last = int(share.argmax()) if share.max() > visited else last
        order[i] = last
    return order


def jumps(order: Order) -> int:
    """How often the attractor visited last became another one."""
    after = order[order >= 0]
    return int(np.count_nonzero(np.diff(after)))
