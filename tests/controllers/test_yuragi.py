"""The paper's law of reaching: what A and epsilon become of what is seen."""

import numpy as np
import pytest
from made_up_map import DYNAMICS, FIELD, MIDDLE, hand_at, learned_map, posture_of, seen_at

from imitation.controllers.yuragi import Yuragi, along_postures

K, EPSILON = 0.02, 0.01  # [1/px]


def yuragi(learned=None, target=MIDDLE, **changes) -> Yuragi:
    """The law as printed, but for the changes, at the beginning of a trial."""
    printed = {
        "gain_per_px": K,
        "noise_per_px": EPSILON,
        "radius": 0.75,
        "noise_steps": 1,
        "noise_along_map": False,
        "distance_cap": np.inf,
        "return_when_unseen": False,
    }
    controller = Yuragi(**{**printed, **changes}, rng=np.random.default_rng(1))
    controller.begin(learned or learned_map(), np.asarray(target))
    return controller


def decisions(controller: Yuragi, distances) -> list:
    """What is decided when the hand is seen at these distances from the target; None: unseen."""
    found = []
    for step, distance in enumerate(distances):
        place = None if distance is None else np.add(MIDDLE, (distance, 0.0))
        percept = hand_at(step, place)
        found.append(controller.decide(seen_at(step, np.zeros(3)), percept, MIDDLE, DYNAMICS))
    return found


def gains(found) -> list[float]:
    return [one.gain for one in found]


def levels(found) -> list[float]:
    return [one.noise_level for one in found]


def test_the_gain_is_k_times_the_distance_while_it_shrinks_and_0_otherwise():
    found = decisions(yuragi(), [10.0, 8.0, 9.0, 9.0, 5.0])
    assert gains(found) == pytest.approx([K * 10, K * 8, 0.0, 0.0, K * 5])


def test_the_noise_level_is_epsilon_times_the_distance_whether_it_shrinks_or_not():
    found = decisions(yuragi(), [10.0, 8.0, 9.0])
    assert levels(found) == pytest.approx([EPSILON * 10, EPSILON * 8, EPSILON * 9])
    for one in found:
        assert 0 < np.abs(one.noise).max() <= one.noise_level


def test_beyond_the_cap_gain_and_noise_grow_no_more():
    found = decisions(yuragi(distance_cap=20.0), [60.0, 50.0, 20.0, 10.0, 40.0])
    assert gains(found) == pytest.approx([K * 20, K * 20, K * 20, K * 10, 0.0])
    assert levels(found) == pytest.approx([EPSILON * d for d in (20, 20, 20, 10, 20)])
    assert [one.distance for one in found] == [60.0, 50.0, 20.0, 10.0, 40.0]


def test_as_printed_an_unseen_hand_is_taken_to_be_where_it_was():
    found = decisions(yuragi(), [10.0, None, None])
    assert gains(found)[1:] == [0.0, 0.0]
    assert levels(found) == pytest.approx([EPSILON * 10] * 3)
    assert np.isnan(found[1].distance)


def test_with_the_repair_an_unseen_hand_is_drawn_back_without_noise():
    found = decisions(yuragi(return_when_unseen=True), [10.0, None, 12.0, 8.0])
    assert gains(found) == pytest.approx([K * 10, 1.0, 0.0, K * 8])
    assert levels(found) == pytest.approx([EPSILON * 10, 0.0, EPSILON * 12, EPSILON * 8])
    assert not found[1].noise.any()


def test_a_hand_never_seen_yet_is_drawn_in_without_noise():
    for repair in (True, False):
        (only,) = decisions(yuragi(return_when_unseen=repair), [None])
        assert (only.gain, only.noise_level) == (1.0, 0.0)


def test_a_new_trial_knows_nothing_of_the_distance_before():
    controller = yuragi()
    decisions(controller, [5.0])
    controller.begin(learned_map(), MIDDLE)
    assert gains(decisions(controller, [30.0])) == pytest.approx([K * 30])


def test_at_the_target_there_is_neither_pull_nor_noise():
    (only,) = decisions(yuragi(), [0.0])
    assert (only.gain, only.noise_level) == (0.0, 0.0)
    assert not only.velocity.any()


def test_noise_lasts_as_many_steps_as_asked_and_is_drawn_anew_then():
    found = decisions(yuragi(noise_steps=5), [10.0] * 11)
    noise = np.array([one.noise for one in found])
    changed = np.flatnonzero(np.any(np.diff(noise, axis=0) != 0, axis=1)) + 1
    assert changed.tolist() == [5, 10]


def test_noise_that_lasts_still_grows_with_the_distance():
    near, far = decisions(yuragi(noise_steps=5), [10.0, 30.0])
    assert far.noise == pytest.approx(3 * near.noise)


def test_the_velocity_is_gain_times_pull_plus_noise_over_tau():
    learned = learned_map()
    controller = yuragi(learned, radius=0.75)
    (only,) = decisions(controller, [10.0])
    pull = np.zeros(3)
    for posture, share in zip(only.postures, only.activation, strict=True):
        pull += share * posture  # the arm is at 0
    assert only.velocity == pytest.approx((K * 10 * pull + only.noise) / 0.1)


def test_areas_centred_nearer_than_the_radius_take_part():
    corner = FIELD.centres[1, 2] + 20.0  # four areas meet there, 28 px from the centres
    for radius, count in ((0.6, 0), (0.75, 4)):
        controller = yuragi(target=corner, radius=radius)
        only = controller.decide(
            seen_at(0, np.zeros(3)), hand_at(0, corner + 9.0), corner, DYNAMICS
        )
        assert len(only.activation) == count


def test_where_nothing_is_learned_the_arm_is_still_and_silent():
    left = FIELD.centres[1, 0]
    controller = yuragi(target=left)
    only = controller.decide(seen_at(0, np.zeros(3)), hand_at(0, left + 9.0), left, DYNAMICS)
    assert only.selection[1, 0] == 1
    assert not only.velocity.any()
    assert not only.noise.any()
    assert len(only.postures) == 0


def test_noise_along_the_map_stays_in_the_span_of_its_postures():
    # The made-up postures lie in a plane through 0: joint 3 = (joint 1 - joint 2) / 2.
    found = decisions(yuragi(noise_along_map=True), [10.0] * 50)
    noise = np.array([one.noise for one in found])
    off_the_plane = noise @ np.array([0.5, -0.5, -1.0])
    assert off_the_plane == pytest.approx(0.0, abs=1e-12)
    assert np.linalg.matrix_rank(noise, tol=1e-9) == 2


def test_isotropic_noise_leaves_the_span_of_the_postures():
    noise = np.array([one.noise for one in decisions(yuragi(), [10.0] * 50)])
    assert np.linalg.matrix_rank(noise, tol=1e-9) == 3


def test_the_longest_direction_of_shaped_noise_keeps_the_length_of_isotropic_noise():
    rng = np.random.default_rng(0)
    spread = rng.standard_normal((400, 3)) * (0.4, 0.2, 0.1)
    lengths = np.linalg.svd(along_postures(spread))[1]
    assert lengths == pytest.approx([1.0, 0.5, 0.25], rel=0.1)


def test_two_postures_are_too_few_to_shape_noise():
    learned = learned_map()
    learned.postures[0], learned.postures[2], learned.postures[1, 1] = np.nan, np.nan, np.nan
    noise = np.array(
        [one.noise for one in decisions(yuragi(learned, noise_along_map=True), [10.0] * 20)]
    )
    assert np.linalg.matrix_rank(noise, tol=1e-9) == 3


def test_learned_in_the_middle_means_drawn_to_the_middle():
    (only,) = decisions(yuragi(radius=0.3), [10.0])
    assert only.postures.tolist() == [posture_of(MIDDLE).tolist()]
    assert only.index.tolist() == [[1, 2, 0]]
