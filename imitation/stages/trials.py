"""Where trials of reaching begin and what they reach for."""

from collections.abc import Iterable

import numpy as np

from imitation.arrays import Array
from imitation.hull import clip_outline, uniform_inside
from imitation.stages.reach import Trial
from imitation.visuo_motor_map import VisuoMotorMap


def random_targets(
    outline: Array, size: tuple[int, int], inset: float, count: int, rng: np.random.Generator
) -> list[Array]:
    """Targets drawn uniformly where the hand was seen in learning, each (2,) [px].

    Args:
        outline: Border of the places where the hand was seen, (n, 2) [px].
        size: Width and height of the visual space [px].
        inset: Targets keep this far from the image's edges, where the hand is cut off [px].
        count: How many.
        rng: Draws them.
    """
    low, high = np.full(2, inset), np.array(size) - inset
    within = clip_outline(outline, low, high)
    if len(within) < 3:
        raise ValueError("the map's learned region is too small to draw targets from")
    return [uniform_inside(within, rng) for _ in range(count)]


def from_learned_postures(
    targets: Iterable[Array], learned: VisuoMotorMap, rng: np.random.Generator
) -> list[Trial]:
    """A trial for each target, from a learned posture that was not seen nearest to it."""
    postures, places = learned.memories()
    if len(postures) < 2:
        raise ValueError(
            f"the map holds {len(postures)} learned postures, reaching needs 2 or more; "
            "learn a fuller one with: imitate learn-map"
        )
    trials = []
    for target in targets:
        nearest = int(np.argmin(np.linalg.norm(places - target, axis=1)))
        others = np.delete(np.arange(len(postures)), nearest)
        trials.append(Trial(target, postures[rng.choice(others)]))
    return trials
