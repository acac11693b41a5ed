"""The control that uses one learned posture."""

import numpy as np
import pytest
from made_up_map import DYNAMICS, FIELD, hand_at, learned_map, posture_of, seen_at

from imitation.controllers.nearest import Nearest


def decided(learned, target, place):
    controller = Nearest(acceleration=np.full(3, 2.0), period=0.04)
    controller.begin(learned, np.asarray(target))
    return controller.decide(
        seen_at(0, np.zeros(3)), hand_at(0, place), np.asarray(target), DYNAMICS
    )


def test_the_only_attractor_is_the_posture_that_was_seen_nearest_to_the_target():
    target = FIELD.centres[0, 3] + (-15.0, 12.0)
    only = decided(learned_map(), target, (60.0, 60.0))
    assert only.index.tolist() == [[0, 3, 0]]
    assert only.postures[0].tolist() == posture_of(FIELD.centres[0, 3]).tolist()
    assert only.selection.sum() == 1


def test_near_is_counted_from_where_the_hand_was_seen_not_from_the_areas_centre():
    learned = learned_map(shift=(-15.0, 0.0))
    target = FIELD.centres[1, 1] + (18.0, 0.0)  # in area [1, 1]; [1, 2] was seen 7 px from it
    assert decided(learned, target, None).index.tolist() == [[1, 2, 0]]


def test_an_area_that_holds_nothing_is_never_nearest():
    learned = learned_map()
    learned.postures[1, 2], learned.places[1, 2] = np.nan, np.nan
    assert decided(learned, FIELD.centres[1, 2] + (2.0, 1.0), None).index.tolist() == [[1, 3, 0]]


def test_it_is_drawn_with_gain_1_and_no_noise_whatever_is_seen():
    target = FIELD.centres[1, 2]
    for place, distance in (((100.0, 75.0), 15.0), (None, np.nan)):
        only = decided(learned_map(), target, place)
        assert (only.gain, only.noise_level) == (1.0, 0.0)
        assert not only.noise.any()
        assert only.distance == pytest.approx(distance, nan_ok=True)
