"""Clusters of learned postures behind the areas of the visual field."""

import numpy as np
import pytest

from imitation.visual_field import VisualField
from imitation.visuo_motor_map import Learning, VisuoMotorMap, neighbourhood

FIELD = VisualField("right_3x3", size=(160, 120), rows=3, columns=3, left=40.0)
LOWER, UPPER = np.array([-1.0, -1.0]), np.array([1.0, 1.0])  # [rad]: scaled joints are radians
AREA = (1, 2)
CENTRE = FIELD.centres[AREA]


def empty_map(neurons: int = 1, alpha: float = 1.0, radius: float = 0.5, **changes: float):
    learning = Learning(
        alpha=alpha,
        min_activity=changes.get("min_activity", 0.3),
        radius=radius,
        excitation=changes.get("excitation", 0.5),
        inhibition=changes.get("inhibition", 1.0),
    )
    return VisuoMotorMap(FIELD, LOWER, UPPER, neurons, learning)


def seen_in(area, activity: float = 1.0) -> np.ndarray:
    visual_input = np.zeros(FIELD.shape)
    visual_input[area] = activity
    return visual_input


def approach_centre(visit: int) -> np.ndarray:
    """A place nearer to the area's centre with each visit, (2,) [px]."""
    return CENTRE + np.array([15.0 / (visit + 1), 0.0])


def test_a_posture_is_strange_by_how_far_it_is_from_all_that_was_learned():
    learned = empty_map()
    assert learned.strangeness(np.zeros(2)) == np.inf
    learned.learn(seen_in(AREA), np.array([0.3, 0.0]), CENTRE)
    learned.learn(seen_in((0, 1)), np.array([0.3, 0.4]), FIELD.centres[0, 1])
    assert learned.strangeness(np.array([0.3, 0.1])) == pytest.approx(0.1)


def test_a_new_map_holds_nothing():
    learned = empty_map(neurons=3)
    assert not learned.learned.any()
    assert len(learned.attractors(np.ones(FIELD.shape), np.zeros(2)).postures) == 0
    assert len(learned.memories()[0]) == 0


def test_the_first_posture_is_taken_whole_whatever_the_learning_rate():
    learned = empty_map(alpha=0.1)
    assert learned.learn(seen_in(AREA), np.array([0.4, -0.6]), CENTRE) == AREA
    assert learned.postures[(*AREA, 0)].tolist() == [0.4, -0.6]
    assert learned.places[(*AREA, 0)].tolist() == CENTRE.tolist()


def test_only_the_most_active_area_learns():
    learned = empty_map()
    visual_input = seen_in(AREA, 0.6) + seen_in((0, 1), 0.4)
    learned.learn(visual_input, np.array([0.1, 0.2]), CENTRE)
    assert np.argwhere(learned.learned).tolist() == [list(AREA)]


def test_a_later_more_central_posture_is_approached_at_the_learning_rate():
    learned = empty_map(alpha=0.25)
    learned.learn(seen_in(AREA), np.array([0.0, 0.0]), CENTRE + 9)
    learned.learn(seen_in(AREA), np.array([0.4, -0.2]), CENTRE + 3)
    assert learned.postures[(*AREA, 0)] == pytest.approx([0.1, -0.05])  # 0 + 0.25 (x - 0)


def test_neighbours_in_the_cluster_learn_less_by_the_table():
    learned = empty_map(neurons=3, alpha=0.5, excitation=1.0, inhibition=2.0)
    learned.postures[AREA] = [[0.0, 0.0], [0.1, 0.1], [0.2, 0.2]]
    learned.learn(seen_in(AREA), np.array([0.0, 0.04]), CENTRE)
    near = neighbourhood(3, 1.0, 2.0)
    assert near == pytest.approx([1.0, 2 * np.exp(-0.5) - np.exp(-0.125), 0.0])
    expected = [0.04 * 0.5, 0.1 + 0.5 * near[1] * (0.04 - 0.1), 0.2]
    assert learned.postures[AREA][:, 1] == pytest.approx(expected)


def test_an_empty_neuron_is_not_drawn_along():
    learned = empty_map(neurons=2, alpha=0.5, excitation=1.0, inhibition=2.0)
    learned.learn(seen_in(AREA), np.array([0.0, 0.0]), CENTRE + 9)
    learned.learn(seen_in(AREA), np.array([0.1, 0.1]), CENTRE + 3)
    assert np.isnan(learned.postures[(*AREA, 1)]).all()


def test_the_most_central_visit_is_kept():
    learned = empty_map()
    near, far = np.array([0.1, 0.1]), np.array([0.2, 0.2])
    assert learned.learn(seen_in(AREA), near, CENTRE + 2) == AREA
    assert learned.learn(seen_in(AREA), far, CENTRE + 12) is None
    assert learned.learn(seen_in(AREA), far, CENTRE + 2) is None
    assert learned.postures[(*AREA, 0)].tolist() == near.tolist()
    assert learned.visits[AREA] == 3


def test_an_empty_image_teaches_nothing():
    learned = empty_map(min_activity=0.0)
    assert learned.learn(np.zeros(FIELD.shape), np.zeros(2), CENTRE) is None
    assert not learned.learned.any()


def test_a_faint_hand_teaches_nothing():
    learned = empty_map(min_activity=0.5)
    assert learned.learn(seen_in(AREA, 0.49), np.zeros(2), CENTRE) is None
    assert learned.visits.sum() == 0
    assert learned.learn(seen_in(AREA, 0.5), np.zeros(2), CENTRE) == AREA


def test_the_left_column_is_never_learned():
    learned = empty_map()
    for row in range(FIELD.rows):
        assert learned.learn(seen_in((row, 0)), np.zeros(2), FIELD.centres[row, 0]) is None
    assert not learned.learned.any()


@pytest.mark.parametrize("neurons", [1, 4, 8])
def test_the_negative_lobe_never_drives_postures_out_of_the_joint_limits(neurons):
    rng = np.random.default_rng(7)
    learned = empty_map(neurons, alpha=0.9, radius=0.1, excitation=0.8, inhibition=3.0)
    for visit in range(1000):
        learned.learn(seen_in(AREA), rng.uniform(LOWER, UPPER), approach_centre(visit))
        held = learned.postures[learned.holds]
        assert (held >= LOWER).all()
        assert (held <= UPPER).all()
    assert learned.holds[AREA].all()


@pytest.mark.parametrize("inhibition", [1.0, 2.0, 10.0])
def test_no_neuron_ever_learns_faster_than_the_winner(inhibition):
    near = neighbourhood(9, 1.0, inhibition)
    assert near[0] == 1
    assert (near >= 0).all()
    assert (near <= 1).all()


def test_inconsistent_postures_go_to_different_neurons_and_the_nearer_one_is_read_out():
    learned = empty_map(neurons=2, alpha=0.5, radius=0.5)
    elbow_up, elbow_down = np.array([0.8, -0.8]), np.array([-0.8, 0.8])
    learned.learn(seen_in(AREA), elbow_up, CENTRE + 9)
    learned.learn(seen_in(AREA), elbow_down, CENTRE + 6)
    assert learned.postures[AREA].tolist() == [elbow_up.tolist(), elbow_down.tolist()]
    for posture in (elbow_up, elbow_down):
        read = learned.attractors(seen_in(AREA), 0.7 * posture)
        assert read.postures.tolist() == [posture.tolist()]


def test_one_neuron_can_only_mix_inconsistent_postures():
    learned = empty_map(neurons=1, alpha=0.5)
    learned.learn(seen_in(AREA), np.array([0.8, -0.8]), CENTRE + 9)
    learned.learn(seen_in(AREA), np.array([-0.8, 0.8]), CENTRE + 6)
    assert learned.postures[(*AREA, 0)] == pytest.approx([0.0, 0.0])


def test_a_full_cluster_gives_an_inconsistent_posture_to_the_nearest_neuron():
    learned = empty_map(neurons=2, radius=0.1)
    for visit, angle in enumerate((-0.8, 0.0, 0.5)):
        learned.learn(seen_in(AREA), np.full(2, angle), approach_centre(visit))
    assert learned.postures[AREA].tolist() == [[-0.8, -0.8], [0.5, 0.5]]


def test_attractors_are_the_selected_and_learned_areas_with_their_weights():
    learned = empty_map()
    learned.learn(seen_in(AREA), np.array([0.1, 0.2]), CENTRE)
    learned.learn(seen_in((0, 1)), np.array([0.3, 0.4]), FIELD.centres[0, 1])
    selection = seen_in(AREA, 0.7) + seen_in((2, 3), 1.0)
    read = learned.attractors(selection, np.zeros(2))
    assert read.postures.tolist() == [[0.1, 0.2]]
    assert read.weights.tolist() == [0.7]
    assert read.index.tolist() == [[*AREA, 0]]


def test_potential_is_1_at_the_learned_posture_falls_with_distance_and_is_0_while_empty():
    learned = empty_map(neurons=2)
    learned.learn(seen_in(AREA), np.array([0.1, 0.2]), CENTRE)
    at, near, far = (
        learned.potential(AREA, np.array([0.1 + away, 0.2])) for away in (0.0, 0.1, 0.5)
    )
    assert at.tolist() == [1.0, 0.0]
    assert 1 > near[0] > far[0] > 0


def test_memories_are_every_posture_with_the_place_it_was_seen_at():
    learned = empty_map(neurons=2)
    learned.learn(seen_in(AREA), np.array([0.8, 0.8]), CENTRE + 3)
    learned.learn(seen_in(AREA), np.array([-0.8, -0.8]), CENTRE + 4)
    postures, places = learned.memories()
    assert postures.tolist() == [[0.8, 0.8], [-0.8, -0.8]]
    assert places.tolist() == [(CENTRE + 3).tolist(), (CENTRE + 4).tolist()]
