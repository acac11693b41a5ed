"""Where a posture shows the hand, read from a learned map."""

import numpy as np

from imitation.arrays import Array
from imitation.regression import locally_linear
from imitation.visuo_motor_map import VisuoMotorMap


def place_shown_at(learned: VisuoMotorMap, posture: Array) -> Array:
    """The place (2,) [px] that the map expects of `posture` (n_joints,) [rad]; nan of few."""
    postures, places = learned.memories()
    return predicted_place(_scaled(learned, postures), places, _scaled(learned, posture))


def prediction_errors(learned: VisuoMotorMap) -> Array:
    """Each posture's seen place predicted from the others by local linear regression, (n,) [px]."""
    postures, places = learned.memories()
    scaled = _scaled(learned, postures)
    errors = []
    for one in range(len(places)):
        others = np.arange(len(places)) != one
        predicted = predicted_place(scaled[others], places[others], scaled[one])
        errors.append(float(np.linalg.norm(predicted - places[one])))
    found = np.array(errors)
    return np.asarray(found[~np.isnan(found)])


def predicted_place(postures: Array, places: Array, at: Array) -> Array:
    """The place (2,) [px] of a posture by local linear regression over others; nan of under 3."""
    if len(places) < 3:
        return np.full(2, np.nan)
    apart = np.linalg.norm(postures - at, axis=1)
    bandwidth = float(np.sort(apart)[min(3, len(apart) - 1)])
    predicted, _ = locally_linear(postures, places, at, bandwidth, 1e-4 * bandwidth**2)
    return predicted


def _scaled(learned: VisuoMotorMap, postures: Array) -> Array:
    return 2 * postures / (learned.upper - learned.lower)
