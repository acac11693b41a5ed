"""The numbers of `metrics.json`, from samples made by hand."""

import numpy as np
import pytest

from imitation.analysis.metrics import (
    ReachMetrics,
    learn_map_metrics,
    neighbour_spread,
    place_errors,
)
from imitation.analysis.place_prediction import prediction_errors
from imitation.perception import Percept
from imitation.robot import Applied, Body, Command, Observation, Truth
from imitation.sample import Decision, Event, Sample
from imitation.visual_field import VisualField
from imitation.visuo_motor_map import Learning, VisuoMotorMap

FIELD = VisualField("right_3x3", (160, 120), rows=3, columns=3, left=40.0)
LEARNING = Learning(alpha=1.0, min_activity=0.5, radius=0.4, excitation=0.8, inhibition=1.6)
BODY = Body("made_up", ("a", "b"), np.full(2, -1.0), np.full(2, 1.0), np.array([0.5, 2.0]), None)
SLOPE = np.array([[40.0, 0.0], [10.0, 30.0]])  # [px/rad]: place = (100, 60) + posture @ SLOPE
OUTLINE = np.array([[40.0, 0.0], [160.0, 0.0], [160.0, 120.0], [40.0, 120.0]])
TARGET = np.array([100.0, 60.0])
PERIOD = 40_000_000  # [ns]


def linear_map(*without) -> VisuoMotorMap:
    """Nine areas seen at their centres, but for those left out; places linear in postures."""
    learned = VisuoMotorMap(FIELD, BODY.lower, BODY.upper, 1, LEARNING)
    for row, column in np.argwhere(FIELD.reachable):
        if (row, column) not in without:
            place = FIELD.centres[row, column]
            learned.places[row, column, 0] = place
            learned.postures[row, column, 0] = (place - TARGET) @ np.linalg.inv(SLOPE)
            learned.visits[row, column] = 1
    return learned


def test_the_place_error_is_the_distance_from_the_areas_centre():
    shown = {(1, 2): np.add(TARGET, (3.0, -4.0)), (0, 1): FIELD.centres[0, 1]}
    assert place_errors(FIELD, shown) == pytest.approx({(1, 2): 5.0, (0, 1): 0.0})


def test_a_map_whose_places_are_linear_in_its_postures_predicts_them():
    errors = prediction_errors(linear_map())
    assert errors.shape == (9,)
    assert errors.max() < 0.1  # the ridge keeps it from being 0


def test_a_posture_that_does_not_fit_its_neighbours_is_predicted_badly():
    learned = linear_map()
    learned.postures[1, 2, 0] += (0.5, 0.0)  # 20 px at 40 px/rad
    errors = prediction_errors(learned)
    assert errors[4] == pytest.approx(20.0, abs=0.2)


def test_three_postures_are_too_few_to_predict_one_from_the_others():
    learned = linear_map(*[(row, column) for row in (1, 2) for column in (1, 2, 3)])
    assert len(prediction_errors(learned)) == 0


def test_spread_is_counted_between_learned_neighbours_only():
    learned = linear_map((1, 2))
    spread = neighbour_spread(learned)
    assert len(spread) == 12 - 4
    beside, below = (np.linalg.norm(step @ np.linalg.inv(SLOPE)) for step in np.eye(2) * 40)
    assert sorted(set(spread.round(9))) == pytest.approx(sorted((beside, below)))


def test_an_area_counts_when_its_posture_showed_the_hand_inside_it():
    learned = linear_map((0, 3), (2, 1))
    learned.visits[2, 1] = 4  # seen, but never central enough to be learned
    shown = {
        (int(row), int(column)): learned.places[row, column, 0]
        for row, column in np.argwhere(learned.learned)
    }
    shown[0, 1] = FIELD.centres[0, 1] + (30.0, 0.0)  # that is in area [0, 2]
    del shown[1, 1]  # not revisited
    metrics = learn_map_metrics(learned, shown)
    assert metrics["areas_total"] == 9
    assert metrics["areas_learned"] == 5
    assert metrics["coverage"] == pytest.approx(5 / 9)
    assert metrics["areas_never_seen"] == [[0, 3]]
    assert metrics["areas_not_confirmed"] == [[0, 1], [1, 1]]
    assert metrics["visits"] == learned.visits.tolist()
    assert metrics["place_error_px"] == 0.0
    assert metrics["place_error_max_px"] == pytest.approx(30.0)


def test_an_empty_map_has_no_errors_rather_than_nan():
    learned = VisuoMotorMap(FIELD, BODY.lower, BODY.upper, 1, LEARNING)
    metrics = learn_map_metrics(learned, {})
    for name in ("place_error_px", "place_error_max_px", "prediction_error_px", "neighbour_spread"):
        assert metrics[name] is None
    assert len(metrics["areas_never_seen"]) == 9


def sample(step: int, posture, distance: float, *events: str, selected: int = 2) -> Sample:
    """A step of a reach for the target."""
    time_ns = step * PERIOD
    selection = np.zeros(FIELD.shape)
    selection[1, 1 : 1 + selected] = 1.0
    zero, nothing = np.zeros(2), np.zeros((0, 2))
    seen = Observation(
        time_ns=time_ns,
        posture=np.asarray(posture, dtype=float),
        velocity=zero,
        gaze=zero,
        frame=np.zeros((1, 1, 3), dtype=np.uint8),
        frame_time_ns=time_ns,
        frame_gaze=zero,
        place_noise=zero,
        opening=1.0,
        proximity=float("inf"),
        touching=False,
    )
    index = np.zeros((0, 3), dtype=np.int32)
    decision = Decision(
        selection, index, nothing, np.zeros(0), nothing, 1.0, 0.0, zero, zero, TARGET, distance
    )
    told = tuple(Event(kind, f"{kind}.") for kind in events)
    nowhere = np.full((*FIELD.shape, 2), np.nan)
    percept = Percept(time_ns, None, np.zeros(FIELD.shape), nowhere, np.empty((0, 2)))
    applied = Applied(zero, zero, zero, (), time_ns)
    return Sample(seen, percept, decision, Command(zero), applied, told)


def truth(step: int, x: float, y: float = 0.0) -> Truth:
    """The true hand at a step, as offset from the target [px]."""
    return Truth(step * PERIOD, np.add(TARGET, (x, y)), np.zeros(3))


def followed(steps, holding: bool = True, learned=None) -> ReachMetrics:
    """Metrics of steps, each a sample and the truth of the same instant."""
    metrics = ReachMetrics(
        learned or linear_map(),
        OUTLINE,
        BODY,
        border=10.0,
        holding=holding,
    )
    for one, *truths in steps:
        metrics.add(one, truths)
    return metrics


# Straight to the target in four steps of 10 px; it is settled at step 4 and held at step 6.
HELD = [
    (sample(0, (0.0, 0.0), 40.0, "episode"), truth(0, -40.0)),
    (sample(1, (0.1, 0.1), 30.0), truth(1, -30.0)),
    (sample(2, (0.2, 0.2), 20.0), truth(2, -20.0)),
    (sample(3, (0.3, 0.3), 10.0), truth(3, -10.0)),
    (sample(4, (0.4, 0.5), 1.0, "reached", "settled"), truth(4, 0.0, 1.0)),
    (sample(5, (0.4, 0.5), 2.0), truth(5, 0.0, 2.5)),
    (sample(6, (0.4, 0.5), 0.5, "held"), truth(6, 0.0, 1.5)),
]


def test_time_and_path_of_a_hold_count_to_its_first_frame():
    (trial,) = followed(HELD).trials
    assert trial["held"]
    assert trial["time_s"] == pytest.approx(4 * 0.04)
    assert trial["path_length_px"] == pytest.approx(30.0 + np.hypot(10.0, 1.0))
    assert trial["straight_px"] == pytest.approx(np.hypot(40.0, 1.0))


def test_the_true_distance_is_the_largest_over_the_held_frames():
    (trial,) = followed(HELD).trials
    assert trial["true_distance_px"] == pytest.approx(2.5)


@pytest.mark.parametrize("steps", [1, 4, 7])
def test_the_time_bound_is_the_slowest_joints_way_to_the_last_posture_at_its_limit(steps):
    (trial,) = followed(HELD[:steps]).trials
    x, y = HELD[steps - 1][0].seen.posture
    assert trial["time_bound_s"] == pytest.approx(max(x / 0.5, y / 2.0))


def test_a_hold_that_was_broken_and_never_came_again_has_no_time_but_the_whole_way():
    broken = [*HELD[:5], (sample(5, (0.5, 0.5), 4.0), truth(5, 4.0, 1.0))]
    (trial,) = followed(broken).trials
    assert trial["reached"]
    assert trial["time_s"] is None
    assert trial["straight_px"] is None
    assert trial["path_length_px"] == pytest.approx(30.0 + np.hypot(10.0, 1.0) + 4.0)


def test_a_trial_tells_where_it_began_and_what_took_part():
    learned = linear_map((1, 1))
    (trial,) = followed(HELD, learned=learned).trials
    assert trial["target_px"] == TARGET.tolist()
    assert trial["start_posture"] == [0.0, 0.0]
    assert trial["activated"] == 1  # of the two selected areas one is learned
    assert trial["nearest_attractor_px"] == pytest.approx(0.0)
    assert trial["final_distance_px"] == 0.5
    assert trial["border"] is False


def test_a_target_near_the_outline_is_a_class_apart():
    metrics = ReachMetrics(linear_map(), OUTLINE, BODY, border=61.0, holding=True)
    metrics.add(HELD[0][0], [])
    assert metrics.trials[0]["border"]


def test_a_hold_that_was_broken_counts_from_the_last_beginning():
    again = [
        *HELD[:5],
        (sample(5, (0.5, 0.5), 4.0), truth(5, 4.0)),
        (sample(6, (0.6, 0.5), 1.0, "settled"), truth(6, 1.0)),
        (sample(7, (0.6, 0.5), 1.0), truth(7, 0.5)),
        (sample(8, (0.6, 0.5), 1.0, "held"), truth(8, 0.5)),
    ]
    (trial,) = followed(again).trials
    assert trial["time_s"] == pytest.approx(6 * 0.04)
    assert trial["true_distance_px"] == pytest.approx(1.0)
    assert trial["path_length_px"] == pytest.approx(
        30.0 + np.hypot(10.0, 1.0) + np.hypot(4.0, 1.0) + 3.0
    )


def test_for_the_papers_law_time_counts_to_the_arrival():
    steps = [
        *HELD[:3],
        (sample(3, (0.3, 0.3), 2.9, "reached"), truth(3, -2.0)),
        (sample(4, (0.4, 0.5), 1.0, "settled"), truth(4, 0.0)),
    ]
    metrics = followed(steps, holding=False)
    assert metrics.trials[0]["time_s"] == pytest.approx(3 * 0.04)
    assert metrics.trials[0]["path_length_px"] == pytest.approx(38.0)
    assert metrics.result("yuragi")["success_rate"] == 1.0
    assert metrics.result("yuragi")["held_rate"] == 0.0


def test_a_trial_that_never_arrives_has_no_time_but_a_path_and_a_distance():
    (trial,) = followed(HELD[:4]).trials
    assert not trial["reached"]
    assert trial["time_s"] is None
    assert trial["true_distance_px"] is None
    assert trial["path_length_px"] == pytest.approx(30.0)
    assert trial["final_distance_px"] == 10.0


def test_the_last_distance_seen_stays_when_the_hand_goes_out_of_view():
    (trial,) = followed([*HELD[:2], (sample(2, (0.2, 0.2), np.nan), truth(2, 90.0))]).trials
    assert trial["final_distance_px"] == 30.0


def test_truth_told_a_step_ahead_is_used_when_its_time_comes():
    (first, *_), (second, *_), (third, *_) = HELD[:3]
    ahead = [(first, truth(0, -40.0), truth(1, -30.0)), (second, truth(2, -20.0)), (third,)]
    (trial,) = followed(ahead[:2]).trials
    assert trial["path_length_px"] == pytest.approx(10.0)
    (trial,) = followed(ahead).trials
    assert trial["path_length_px"] == pytest.approx(20.0)


def test_without_a_truth_nothing_is_claimed_of_the_true_hand():
    (trial,) = followed([(one,) for one, _ in HELD]).trials
    assert trial["held"]
    assert trial["time_s"] == pytest.approx(0.16)
    for name in ("true_distance_px", "path_length_px", "straight_px"):
        assert trial[name] is None


def test_rates_and_the_median_time_are_over_all_trials_and_those_that_succeeded():
    later = [
        (sample(20 + step, one.seen.posture, one.decision.distance, *kinds), *truths)
        for step, (one, *truths) in enumerate(HELD[:5])
        for kinds in [[event.kind for event in one.events]]
    ]
    metrics = followed([*HELD, *later])
    result = metrics.result("corrected_aim")
    assert result["controller"] == "corrected_aim"
    assert (result["success_rate"], result["held_rate"], result["reached_rate"]) == (0.5, 0.5, 1.0)
    assert result["median_time_s"] == pytest.approx(0.16)
    assert len(result["trials"]) == 2


def test_no_trial_at_all_is_no_rate():
    result = followed([]).result("corrected_aim")
    assert result["success_rate"] is None
    assert result["median_time_s"] is None
