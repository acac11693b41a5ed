"""Where to move next while the map is being learned: where it is still empty."""

from dataclasses import dataclass

import numpy as np

from imitation.arrays import Array
from imitation.deciding import one_attractor
from imitation.hull import nearest_mixture
from imitation.regression import locally_linear
from imitation.visual_field import Area
from imitation.visuo_motor_map import Attractors, VisuoMotorMap


@dataclass(frozen=True)
class Goal:
    """A posture to go to."""

    attractor: Attractors  # the posture alone, with the neuron that holds it
    selection: Array  # V that stands for it, (rows, columns)
    area: Area | None  # the area it is hoped to show the hand in
    place: Array | None  # centre of that area, (2,) [px]

    @property
    def posture(self) -> Array:
        """Where the arm is to go, (n_joints,) [rad]."""
        return np.asarray(self.attractor.postures[0])


@dataclass(frozen=True)
class Curiosity:
    """How babbling chooses its goals."""

    central: float  # an area is finished when seen this near to its centre [sides of an area]
    spacing: float  # memories are at least this far apart [px]
    bandwidth: float  # of the local regression from places to postures [px]
    ridge: float  # of the same [px^2]
    jitter: float  # noise added to a goal for each failed try [-1..1 between guided postures]
    random: float  # share of goals that are random mixtures


class Babbling:
    """Goals inside the convex hull of the guided postures.

    Nothing here knows the arm's geometry: which posture may show the hand where is guessed by
    local regression from what was seen so far.

    Args:
        guided: Postures the experimenter guided the arm to, (n, n_joints) [rad].
        curiosity: How goals are chosen.
        speed: What each joint can do, (n_joints,) [rad/s]: near is what is reached soon.
        rng: Draws goals.
    """

    def __init__(
        self, guided: Array, curiosity: Curiosity, speed: Array, rng: np.random.Generator
    ) -> None:
        self.guided, self.curiosity, self._rng = guided, curiosity, rng
        self._speed = speed
        self._spread = np.ptp(guided, axis=0)
        self._places: list[Array] = []
        self._postures: list[Array] = []
        self._tries: dict[Area, int] = {}

    def remember(self, place: Array, posture: Array) -> None:
        """Keep that `posture` [rad] showed the hand at `place` [px], unless known already."""
        if self._places:
            apart = np.linalg.norm(np.asarray(self._places) - place, axis=1)
            if apart.min() < self.curiosity.spacing:
                return
        self._places.append(place)
        self._postures.append(posture)

    def content(self, learned: VisuoMotorMap) -> bool:
        """Whether every area within reach was seen near its centre."""
        return not self._wanting(learned)

    def next_goal(self, learned: VisuoMotorMap, posture: Array) -> Goal:
        """The nearest area that is still wanting, or now and then anywhere."""
        if len(self._places) < 3 or self._rng.random() < self.curiosity.random:
            return self._anywhere(learned)
        wanting = self._wanting(learned)
        fewest = min(self._tries.get(area, 0) for area in wanting)
        candidates = [area for area in wanting if self._tries.get(area, 0) == fewest]
        guesses = [self._guess(learned, area) for area in candidates]
        chosen = int(np.argmin([self._travel(guess, posture) for guess in guesses]))
        area, guess = candidates[chosen], guesses[chosen]
        noise = self.curiosity.jitter * fewest * self._spread
        guess = self._inside(guess + noise * self._rng.standard_normal(len(guess)))
        self._tries[area] = fewest + 1
        return self._towards(learned, area, one_attractor(guess))

    def nearest_learned(self, learned: VisuoMotorMap, areas: set[Area], posture: Array) -> Goal:
        """The learned posture among `areas` that takes the shortest way from `posture`."""
        ordered = sorted(areas)
        known = [learned.attractors(_only(learned, area), posture) for area in ordered]
        chosen = int(np.argmin([self._travel(one.postures[0], posture) for one in known]))
        return self._towards(learned, ordered[chosen], known[chosen])

    def _wanting(self, learned: VisuoMotorMap) -> list[Area]:
        field = learned.field
        off = learned.distances(field.centres)
        open_areas = field.reachable & (off > self.curiosity.central * field.side)
        return [(int(row), int(column)) for row, column in np.argwhere(open_areas)]

    def _guess(self, learned: VisuoMotorMap, area: Area) -> Array:
        places, postures = np.asarray(self._places), np.asarray(self._postures)
        curiosity = self.curiosity
        guess, _ = locally_linear(
            places, postures, learned.field.centres[area], curiosity.bandwidth, curiosity.ridge
        )
        return self._inside(guess)

    def _anywhere(self, learned: VisuoMotorMap) -> Goal:
        mixture = self._rng.dirichlet(np.ones(len(self.guided)))
        nowhere = np.zeros(learned.field.shape)
        return Goal(one_attractor(mixture @ self.guided), nowhere, None, None)

    def _towards(self, learned: VisuoMotorMap, area: Area, attractor: Attractors) -> Goal:
        return Goal(attractor, _only(learned, area), area, learned.field.centres[area])

    def _inside(self, posture: Array) -> Array:
        return nearest_mixture(self.guided, posture)

    def _travel(self, posture: Array, start: Array) -> float:
        return float((np.abs(posture - start) / self._speed).max())


def _only(learned: VisuoMotorMap, area: Area) -> Array:
    """V that selects one area, (rows, columns)."""
    selection = np.zeros(learned.field.shape)
    selection[area] = 1.0
    return selection
