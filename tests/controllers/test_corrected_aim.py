"""One attractor between the learned postures, its aim corrected by the error seen."""

import numpy as np
import pytest
from made_up_map import DYNAMICS, MIDDLE, SLOPE, hand_at, learned_map, posture_of, seen_at

from imitation.controllers.corrected_aim import CorrectedAim

TARGET = np.add(MIDDLE, (9.0, -13.0))  # in no area's centre
FAR = posture_of(np.add(MIDDLE, (-40.0, 0.0)))
ACCELERATION = np.array([2.0, 1.0, 4.0])  # [rad/s^2]


def corrected_aim(target=TARGET, **changes) -> CorrectedAim:
    settings = {"bandwidth": 0.75, "ridge": 1e-9, "settling": 0.1, "noise": 2.0, "largest": 35.0}
    controller = CorrectedAim(**{**settings, **changes}, acceleration=ACCELERATION, period=0.04)
    controller.begin(learned_map(), np.asarray(target))
    return controller


def decide(controller, step, posture, place, frame_step=None):
    percept = hand_at(step if frame_step is None else frame_step, place)
    return controller.decide(seen_at(step, posture), percept, TARGET, DYNAMICS)


def aimed_at(decision) -> np.ndarray:
    """The place that the map's line gives the attractor, (2,) [px]."""
    return MIDDLE + decision.postures[0] @ np.linalg.pinv(SLOPE)


def test_an_unseen_hand_is_drawn_to_the_posture_between_the_learned_ones():
    only = decide(corrected_aim(), 0, FAR, None)
    assert only.postures[0] == pytest.approx(posture_of(TARGET), abs=1e-6)
    assert np.isnan(only.distance)


def test_a_hand_seen_where_the_map_says_corrects_nothing():
    controller = corrected_aim()
    for step, share in enumerate((0.0, 0.3, 0.8, 1.0)):
        place = np.add(MIDDLE, (-40.0, 0.0)) + share * (TARGET - MIDDLE - (-40.0, 0.0))
        only = decide(controller, step, posture_of(place), place)
    assert only.postures[0] == pytest.approx(posture_of(TARGET), abs=1e-5)
    assert only.distance == pytest.approx(0.0, abs=1e-9)


def test_a_first_error_moves_the_aim_by_as_much_to_the_other_side():
    error = np.array([6.0, -2.0])
    only = decide(corrected_aim(), 0, posture_of(TARGET), TARGET + error)
    assert aimed_at(only) == pytest.approx(TARGET - error, abs=1e-3)
    assert only.distance == pytest.approx(np.hypot(6.0, 2.0))


def test_the_aim_is_moved_by_no_more_than_the_largest_correction():
    only = decide(corrected_aim(largest=10.0), 0, posture_of(TARGET), np.add(TARGET, (40.0, 0.0)))
    assert aimed_at(only) == pytest.approx(TARGET - (10.0, 0.0), abs=1e-3)


def test_a_late_frame_is_compared_with_the_posture_it_was_taken_at():
    controller, start = corrected_aim(), np.add(MIDDLE, (-40.0, 0.0))
    places = [start + share * (TARGET - start) for share in np.linspace(0.0, 1.0, 11)]
    for step, place in enumerate(places):
        late = max(step - 5, 0)
        only = decide(controller, step, posture_of(place), places[late], frame_step=late)
    assert only.postures[0] == pytest.approx(posture_of(TARGET), abs=1e-5)


def test_at_rest_errors_are_averaged_over_the_settling_time():
    controller, at = corrected_aim(), posture_of(TARGET)
    decide(controller, 0, at, TARGET)
    only = decide(controller, 1, at, np.add(TARGET, (5.0, 0.0)))
    assert aimed_at(only) == pytest.approx(TARGET - (5.0 * 0.04 / 0.1, 0.0), abs=1e-3)


def test_periods_longer_than_the_settling_time_correct_by_the_newest_error_and_no_more():
    controller = corrected_aim(settling=0.01)
    for step, error in enumerate((6.0, 2.0)):
        only = decide(controller, step, posture_of(TARGET), np.add(TARGET, (error, 0.0)))
    assert aimed_at(only) == pytest.approx(TARGET - (2.0, 0.0), abs=1e-3)


def test_a_moved_hand_forgets_old_errors_by_how_far_it_moved():
    controller = corrected_aim(settling=100.0)
    decide(controller, 0, posture_of(TARGET), TARGET)
    aside = np.add(TARGET, (6.0, 0.0))
    only = decide(controller, 1, posture_of(aside), np.add(aside, (0.0, 4.0)))
    assert aimed_at(only) == pytest.approx(TARGET - (0.0, 4.0 * 6.0 / (6.0 + 2.0)), abs=1e-3)


def test_the_same_frame_twice_counts_once():
    controller, at = corrected_aim(), posture_of(TARGET)
    decide(controller, 0, at, TARGET)
    once = decide(controller, 1, at, np.add(TARGET, (5.0, 0.0)))
    again = decide(controller, 2, at, np.add(TARGET, (5.0, 0.0)), frame_step=1)
    assert again.postures[0] == pytest.approx(once.postures[0], abs=1e-12)


def test_a_new_trial_forgets_the_error_of_the_one_before():
    controller = corrected_aim()
    decide(controller, 0, posture_of(TARGET), np.add(TARGET, (6.0, -2.0)))
    controller.begin(learned_map(), TARGET)
    only = decide(controller, 1, FAR, None)
    assert only.postures[0] == pytest.approx(posture_of(TARGET), abs=1e-6)


def test_the_attractor_stays_within_the_joint_limits():
    controller = corrected_aim(largest=1000.0)
    only = decide(controller, 0, posture_of(TARGET), np.add(TARGET, (0.0, -900.0)))
    assert (np.abs(only.postures[0]) <= 1.0).all()
    assert np.abs(only.postures[0]).max() == 1.0


def test_an_arm_that_obeys_never_overshoots_the_attractor():
    controller, posture = corrected_aim(), FAR
    way = posture_of(TARGET) - FAR
    for step in range(100):
        only = decide(controller, step, posture, None)
        posture = posture + 0.04 * only.velocity
        assert (posture - FAR) @ way <= way @ way + 1e-9
    assert posture == pytest.approx(posture_of(TARGET), abs=1e-3)
