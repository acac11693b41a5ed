"""A map set by hand, for an arm of three joints, with postures linear in the places seen."""

import numpy as np

from imitation.arrays import Array
from imitation.dynamics import Dynamics
from imitation.perception import Percept
from imitation.robot import Observation
from imitation.visual_field import VisualField
from imitation.visuo_motor_map import Learning, VisuoMotorMap

FIELD = VisualField("right_3x3", (160, 120), rows=3, columns=3, left=40.0)
LOWER, UPPER = np.full(3, -1.0), np.full(3, 1.0)  # [rad]: scaled joints are radians
DYNAMICS = Dynamics(LOWER, UPPER, tau=0.1, beta=2.0)
MIDDLE = np.array([100.0, 60.0])  # centre of area [1, 2] [px]
SLOPE = np.array([[0.008, 0.0, 0.004], [0.0, 0.008, -0.004]])  # [rad/px]


def posture_of(place) -> Array:
    """The posture that shows the hand at `place` [px]."""
    return (np.asarray(place, dtype=float) - MIDDLE) @ SLOPE


def learned_map(shift=(0.0, 0.0)) -> VisuoMotorMap:
    """Nine areas, each learned `shift` px beside its centre."""
    learning = Learning(alpha=1.0, min_activity=0.5, radius=0.4, excitation=0.8, inhibition=1.6)
    learned = VisuoMotorMap(FIELD, LOWER, UPPER, 1, learning)
    for row, column in np.argwhere(FIELD.reachable):
        place = FIELD.centres[row, column] + shift
        learned.places[row, column, 0] = place
        learned.postures[row, column, 0] = posture_of(place)
        learned.visits[row, column] = 1
    return learned


def seen_at(step: int, posture) -> Observation:
    """What is sensed at a control step of 0.04 s; the frame shows nothing."""
    return Observation(
        time_ns=step * 40_000_000,
        posture=np.asarray(posture, dtype=float),
        velocity=np.zeros(3),
        gaze=np.zeros(2),
        frame=np.zeros((1, 1, 3), dtype=np.uint8),
        frame_time_ns=step * 40_000_000,
        frame_gaze=np.zeros(2),
        place_noise=np.zeros(2),
        opening=1.0,
        proximity=float("inf"),
        touching=False,
    )


def hand_at(step: int, place) -> Percept:
    """The hand seen at `place` [px] in the frame of a step; None: not seen."""
    hand = None if place is None else np.asarray(place, dtype=float)
    seen = np.empty((0, 2)) if hand is None else hand[None]
    return Percept(step * 40_000_000, hand, FIELD.activity(seen), FIELD.mean_places(seen), seen)
