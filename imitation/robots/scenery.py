"""Builds what there is before the robot from plain values: another's hand, a can on the table."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from imitation.arrays import Array
from imitation.gaze import VisualSpace
from imitation.robots.bullet.world_can import Can
from imitation.robots.demonstrators import Hand, HandOverTable
from imitation.robots.hand_paths import Gesture

Numbers = Sequence[float]


def hand_over_table(
    node: Mapping[str, Any], gesture: Gesture, space: VisualSpace, eye: Numbers
) -> HandOverTable:
    """A demonstrator whose hand follows `gesture` in `space`; `node` is that of `demonstrator=`."""
    look, known = node["hand"], node["hands"]
    if look not in known:
        raise ValueError(f"demonstrator.hand={look} is no hand; type one of {', '.join(known)}")
    red, green, blue, opacity = known[look]["colour"]
    hand = Hand(known[look]["radius"], (red, green, blue, opacity))
    return HandOverTable(hand, gesture, space, np.asarray(eye), node["height"], node["raise"])


def can_on_table(
    node: Mapping[str, Any],
    robot: Mapping[str, Any],
    space: VisualSpace,
    eye: Numbers,
    rng: np.random.Generator,
) -> Can:
    """A can where a hand that holds it would be seen.

    Args:
        node: That of `object=`.
        robot: That of `robot=`.
        space: Visual space of learning.
        eye: Optical centre of the camera, (3,) [m].
        rng: Scatters the can.
    """
    table = robot["arm"]["table"]
    place = held_at(np.asarray(node["seen_px"]), robot, space, eye, robot["holding"]["height"])
    x, y = place + node["off_m"] + within_disc(node["scatter"], rng)
    top = table["centre"][2] + table["size"][2] / 2
    red, green, blue, opacity = node["colour"]
    shape = {key: node[key] for key in ("radius", "height", "mass")}
    grip = {key: node[key] for key in ("friction", "spinning", "rolling")}
    centre = (float(x), float(y), top + node["height"] / 2)
    return Can(**shape, **grip, colour=(red, green, blue, opacity), centre=centre)


def held_at(
    seen: Array, robot: Mapping[str, Any], space: VisualSpace, eye: Numbers, height: float
) -> Array:
    """Where a hand holds something whose mark is `seen` (2,) [px] at `height` [m], (2,) [m]."""
    mark = space.unproject(seen, np.asarray(eye), height)[:2]
    away = mark - robot["arm"]["base"][:2]
    return np.asarray(mark - robot["holding"]["outwards"] * away / np.linalg.norm(away))


def within_disc(radius: float, rng: np.random.Generator) -> Array:
    """A point drawn uniformly within `radius` of the origin, (2,)."""
    share, angle = rng.random(), rng.uniform(0, 2 * np.pi)
    return np.asarray(radius * np.sqrt(share) * np.array((np.cos(angle), np.sin(angle))))
