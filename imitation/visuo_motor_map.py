"""The visuo-motor map: behind each area of the visual field, a cluster of learned postures."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from imitation.arrays import Array, Index, Mask
from imitation.regression import locally_linear
from imitation.visual_field import Area, VisualField, most_active


def neighbourhood(neurons: int, excitation: float, inhibition: float) -> Array:
    """Difference-of-Gaussians table over topological distance 0..neurons-1, 1 at distance 0.

    As printed, eq. 4 diverges with it: the negative lobe pushes weights away without end. Here
    the lobe is cut off at 0, so that each weight moves towards the posture or not at all.

    Args:
        neurons: Size of the cluster.
        excitation: Width of the positive Gaussian [neurons].
        inhibition: Width of the negative Gaussian [neurons], the larger one.
    """
    distance = np.arange(neurons)
    positive = 2.0 * np.exp(-(distance**2) / (2 * excitation**2))
    negative = np.exp(-(distance**2) / (2 * inhibition**2))
    return np.maximum(positive - negative, 0.0)


@dataclass(frozen=True)
class Attractors:
    """The learned postures that a selection lets take part."""

    postures: Array  # (n, n_joints) [rad]
    weights: Array  # visual weight V of each, (n,)
    index: Index  # row, column, neuron of each, (n, 3)


@dataclass(frozen=True)
class Learning:
    """How a cluster learns."""

    alpha: float  # learning rate of eq. 4, 0..1
    min_activity: float  # a visual input below this teaches nothing
    radius: float  # a posture farther than this from all of a cluster takes a free neuron [-1..1]
    excitation: float  # width of the cluster's positive Gaussian [neurons]
    inhibition: float  # width of its negative Gaussian [neurons]


class VisuoMotorMap:
    """Clusters of neurons with the topology of the visual field (section II).

    Each cluster is a small self-organized map over postures. A neuron starts empty, and learns
    the first posture whole.

    Attributes:
        postures: Learned posture of each neuron, (rows, columns, neurons, n_joints) [rad]; nan
            while empty.
        places: Where the hand was seen when a neuron learned last, (rows, columns, neurons, 2)
            [px of visual space].
        visits: How often the hand was seen in each area, (rows, columns).
    """

    def __init__(
        self, field: VisualField, lower: Array, upper: Array, neurons: int, learning: Learning
    ) -> None:
        self.field, self.lower, self.upper, self.learning = field, lower, upper, learning
        self.neurons = neurons
        shape = (*field.shape, neurons)
        self.postures = np.full((*shape, len(lower)), np.nan)
        self.places = np.full((*shape, 2), np.nan)
        self.visits = np.zeros(field.shape, dtype=np.int64)
        self._near = neighbourhood(neurons, learning.excitation, learning.inhibition)

    @property
    def holds(self) -> Mask:
        """Which neurons hold a posture, (rows, columns, neurons)."""
        return np.asarray(~np.isnan(self.postures[..., 0]))

    @property
    def learned(self) -> Mask:
        """Which areas are learned, (rows, columns)."""
        return np.asarray(self.holds.any(axis=-1))

    def potential(self, area: Area, posture: Array) -> Array:
        """Potential of a cluster's neurons, (neurons,): 1 at their own posture, 0 while empty."""
        distance = self._distance(area, posture)
        return np.where(np.isnan(distance), 0.0, np.exp(-np.nan_to_num(distance)))

    def learn(self, visual_input: Array, posture: Array, place: Array) -> Area | None:
        """Associate `posture` (n_joints,) [rad] with the most active area (eqs. 3 and 4).

        A neuron keeps the most central of its visits: it learns when the hand is seen at `place`
        (2,) [px] nearer to the area's centre than before.

        Returns:
            The area that learned; None when nothing did.
        """
        area = self.trigger(visual_input)
        if area is None:
            return None
        self.visits[area] += 1
        neuron = self._neuron_for(area, posture)
        if not self._more_central(area, neuron, place):
            return None
        self._approach(area, neuron, posture)
        self.places[(*area, neuron)] = place
        return area

    def trigger(self, visual_input: Array) -> Area | None:
        """The area whose cluster learns: the most active one (eq. 3), if it is within reach."""
        if visual_input.max() < self.learning.min_activity:
            return None
        area = most_active(visual_input)
        return area if self.field.reachable[area] else None

    def attractors(self, selection: Array, posture: Array) -> Attractors:
        """Postures of the selected learned areas, of each cluster the one nearest to `posture`.

        Args:
            selection: V, (rows, columns).
            posture: The present posture, (n_joints,) [rad].
        """
        areas = ((selection > 0) & self.learned).nonzero()
        distance = self._distance(areas, posture)
        neurons = np.where(np.isnan(distance), np.inf, distance).argmin(axis=-1)
        index = np.array((*areas, neurons), dtype=np.int32).T
        return Attractors(self.postures[(*areas, neurons)], selection[areas], index)

    def learned_area(self, place: Array) -> Area | None:
        """The learned area that `place` (2,) [px] lies in; None: it lies in none."""
        area = self.field.area_of(place)
        return area if area is not None and self.learned[area] else None

    def distances(self, place: Array) -> Array:
        """Of each area's nearest learned place to `place`, (rows, columns) [px]; inf: it has none.

        Args:
            place: (2,) [px], or one for each area, (rows, columns, 2).
        """
        off = np.linalg.norm(self.places - place[..., None, :], axis=-1)
        return np.asarray(np.where(np.isnan(off), np.inf, off).min(axis=-1))

    def strangeness(self, posture: Array) -> float:
        """Distance of `posture` (n_joints,) [rad] to the nearest learned one [-1..1]."""
        return float(np.nanmin(self._distance(self.learned.nonzero(), posture), initial=np.inf))

    def memories(self) -> tuple[Array, Array]:
        """All learned postures (n, n_joints) [rad] and where each was seen (n, 2) [px]."""
        return self.postures[self.holds], self.places[self.holds]

    def read(self, place: Array, bandwidth: float, ridge: float) -> tuple[Array, Array]:
        """Reads the map between its places: posture is taken as linear in the place around it.

        Args:
            place: Where the hand is to be seen, (2,) [px].
            bandwidth: Of the regression from learned places to postures [area sides].
            ridge: Of the same [area sides squared].

        Returns:
            The posture (n_joints,) [rad] and its slope (2, n_joints) [rad/px].
        """
        postures, places = self.memories()
        side = self.field.side
        return locally_linear(places, postures, place, bandwidth * side, ridge * side**2)

    def _distance(self, area: Area | tuple[NDArray[np.integer], ...], posture: Array) -> Array:
        """Distance of a cluster's postures to `posture`, (neurons,) [-1..1]; nan while empty.

        Of several areas, given as their rows and their columns, (n, neurons).
        """
        apart = (self.postures[area] - posture) * 2 / (self.upper - self.lower)
        return np.asarray(np.linalg.norm(apart, axis=-1))

    def _neuron_for(self, area: Area, posture: Array) -> int:
        distance = self._distance(area, posture)
        empty = np.flatnonzero(np.isnan(distance))
        if len(empty) and not np.any(distance <= self.learning.radius):
            return int(empty[0])
        return int(np.nanargmin(distance))

    def _more_central(self, area: Area, neuron: int, place: Array) -> bool:
        centre, before = self.field.centres[area], self.places[(*area, neuron)]
        return not np.linalg.norm(before - centre) <= np.linalg.norm(place - centre)

    def _approach(self, area: Area, winner: int, posture: Array) -> None:
        if np.isnan(self.postures[(*area, winner)]).any():
            self.postures[(*area, winner)] = posture
            return
        weights = self.postures[area]  # of the cluster, (neurons, n_joints)
        topological = np.abs(np.arange(self.neurons) - winner)
        rate = self.learning.alpha * self._near[topological]
        weights += rate[:, None] * (posture - weights)  # eq. 4; an empty neuron stays nan
        np.clip(weights, self.lower, self.upper, out=weights)
