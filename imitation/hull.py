"""Convex hulls: of guided postures in joint space, of seen places in the image."""

import cv2
import numpy as np

from imitation.arrays import Array

ITERATIONS = 300  # of the projection below; it settles well before


def onto_simplex(weights: Array) -> Array:
    """The nearest weights that are not negative and sum to 1, (n,)."""
    descending = np.sort(weights)[::-1]
    excess = (np.cumsum(descending) - 1) / np.arange(1, len(weights) + 1)
    kept = np.flatnonzero(descending > excess)[-1]
    return np.asarray(np.maximum(weights - excess[kept], 0.0))


def nearest_mixture(corners: Array, point: Array) -> Array:
    """The point of the corners' convex hull nearest to `point` (n,), by projected gradient.

    Args:
        corners: (n_corners, n).
        point: (n,).
    """
    step = 1.0 / np.linalg.norm(corners, 2) ** 2
    weights = np.full(len(corners), 1.0 / len(corners))
    ahead, momentum = weights, 1.0
    for _ in range(ITERATIONS):
        slope = corners @ (ahead @ corners - point)
        after = onto_simplex(ahead - step * slope)
        faster = (1 + np.sqrt(1 + 4 * momentum**2)) / 2
        ahead = after + (momentum - 1) / faster * (after - weights)
        weights, momentum = after, faster
    return np.asarray(weights @ corners)


def outline(places: Array) -> Array:
    """Corners of the convex hull of `places` (n, 2) [px], (n_corners, 2), in order."""
    return np.asarray(cv2.convexHull(places.astype(np.float32))[:, 0], dtype=np.float64)


def depth_inside(corners: Array, place: Array) -> float:
    """How far `place` (2,) [px] lies inside an outline [px]; negative outside."""
    x, y = (float(value) for value in place)
    return float(cv2.pointPolygonTest(corners.astype(np.float32), (x, y), True))


def clip_outline(corners: Array, low: Array, high: Array) -> Array:
    """The part of a convex outline inside the box `low`..`high` (2,) [px]."""
    box = np.array(((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])))
    _, common = cv2.intersectConvexConvex(corners.astype(np.float32), box.astype(np.float32))
    if common is None:
        return np.empty((0, 2))
    return np.asarray(common[:, 0], dtype=np.float64)


def uniform_inside(corners: Array, rng: np.random.Generator) -> Array:
    """A place drawn uniformly inside a convex outline, (2,) [px]."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    while True:
        place = rng.uniform(low, high)
        if depth_inside(corners, place) >= 0:
            return np.asarray(place)
