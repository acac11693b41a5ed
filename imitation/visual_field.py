"""The visual field: a grid of visual neurons over the image, each looking at one area."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from imitation.arrays import Array, Mask

Area = tuple[int, int]  # row, column
INSIDE = 0.01  # so far from its right and lower border a place is in an area for certain [px]


@dataclass(frozen=True)
class VisualField:
    """Areas of equal size on the right of the image, and one more column on its left.

    The right ones are within the arm's reach and are learned; the left column is seen only.
    Areas are counted [row, column] over the whole grid, so column 0 is the left one.
    """

    name: str
    size: tuple[int, int]  # width, height of the visual space [px]
    rows: int
    columns: int  # columns within reach, without the left one
    left: float  # width of the left column [px]

    @cached_property
    def edges(self) -> tuple[Array, Array]:
        """Borders of the columns, then of the rows [px]."""
        width, height = self.size
        right = np.linspace(self.left, width, self.columns + 1)
        return np.concatenate(((0.0,), right)), np.linspace(0.0, height, self.rows + 1)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the whole grid, the left column included."""
        return self.rows, self.columns + 1

    @cached_property
    def centres(self) -> Array:
        """Centre of each area, (rows, columns, 2) as x, y [px]."""
        x_edges, y_edges = self.edges
        x, y = (x_edges[1:] + x_edges[:-1]) / 2, (y_edges[1:] + y_edges[:-1]) / 2
        return np.stack(np.meshgrid(x, y), axis=-1)

    @property
    def side(self) -> float:
        """Width of an area within reach [px]."""
        return (self.size[0] - self.left) / self.columns

    @cached_property
    def reachable(self) -> Mask:
        """Which areas the arm can learn, (rows, columns)."""
        within = np.ones(self.shape, dtype=bool)
        within[:, 0] = False
        return within

    def activity(self, places: Array) -> Array:
        """Visual input I: each area's share of the hand's pixels (n, 2) [px]; 0 when unseen."""
        return self._summed(self._cells(places), None) / max(len(places), 1)

    def mean_places(self, places: Array) -> Array:
        """Mean of the `places` (n, 2) [px] in each area, (rows, columns, 2); nan in empty ones."""
        cells = self._cells(places)
        x, y = (self._summed(cells, axis) for axis in places.T)
        count = self._summed(cells, None)[..., None]
        return np.where(count > 0, np.stack((x, y), axis=-1) / np.maximum(count, 1), np.nan)

    def inside(self, areas: Mask, places: Array) -> Mask:
        """Which `places` (n, 2) [px] lie in one of `areas` (rows, columns), (n,)."""
        return np.asarray(np.pad(areas, 1)[self._framed(places)])

    def around(self, area: Area) -> Mask:
        """An area and its neighbours, those at its corners too, (rows, columns)."""
        rows, columns = np.indices(self.shape)
        return np.asarray((abs(rows - area[0]) <= 1) & (abs(columns - area[1]) <= 1))

    def area_of(self, place: Array) -> Area | None:
        """The area that `place` (2,) [px] lies in; None outside the visual space."""
        activity = self.activity(place[None])
        if not activity.any():
            return None
        return most_active(activity)

    def into(self, place: Array, area: Area, margin: float = 0.0) -> Array:
        """The place in `area`, `margin` from its border, that is nearest to `place`, (2,) [px]."""
        (x_edges, y_edges), (row, column) = self.edges, area
        low, high = (x_edges[column], y_edges[row]), (x_edges[column + 1], y_edges[row + 1])
        return np.clip(place, np.add(low, margin), np.subtract(high, max(margin, INSIDE)))

    def within(self, place: Array, radius: float) -> Array:
        """Selection V: 1 for every area whose centre is nearer than `radius` [px] to `place`."""
        near = np.linalg.norm(self.centres - place, axis=-1) < radius
        return np.asarray(near, dtype=np.float64)

    def _cells(self, places: Array) -> NDArray[np.intp]:
        """Which area of the framed field each place lies in, counted along the rows, (n,)."""
        rows, columns = self._framed(places)
        return rows * (self.columns + 3) + columns

    def _summed(self, cells: NDArray[np.intp], weights: Array | None) -> Array:
        """Sum of the weights (n,) of what lies in each area; None: each weighs 1."""
        framed = (self.rows + 2, self.columns + 3)
        sums = np.bincount(cells, weights, framed[0] * framed[1])
        return np.asarray(sums.reshape(framed)[1:-1, 1:-1])

    def _framed(self, places: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Row and column of each place, counted from 1: those outside are in the frame around."""
        x_edges, y_edges = self.edges
        columns = x_edges.searchsorted(places[:, 0], side="right")
        return y_edges.searchsorted(places[:, 1], side="right"), columns


def most_active(activity: Array) -> Area:
    """The area with the largest activity (rows, columns); among equals the first one."""
    row, column = np.unravel_index(activity.argmax(), activity.shape)
    return int(row), int(column)


def winner_take_all(visual_input: Array) -> Array:
    """Selection V by hard competition: 1 for the most active area, 0 elsewhere (section III).

    All 0 when nothing is seen; among equals the first one wins.
    """
    selection = np.zeros_like(visual_input)
    if visual_input.max() > 0:
        selection.flat[visual_input.argmax()] = 1.0
    return selection
