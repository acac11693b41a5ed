"""Where a demonstrator's hand is over time."""

import numpy as np
import pytest
from on_bench import bench

from imitation.robots.gestures import pick_and_place, trigger, waypoints
from imitation.robots.hand_paths import Waypoints

FIGURES = ("line", "circle", "square", "figure_eight")
PERIOD = 4.0  # [s]


def gesture_of(name: str, *words: str):
    return bench("learn-map", f"demonstrator={name}", *words).demonstrator.gesture


def way(name: str, *words: str, step: float = 0.01):
    """Places of one lap at a fast pace, (n, 2) [px]."""
    gesture = gesture_of(name, f"demonstrator.period={PERIOD}", *words)
    return np.array([gesture.place(1.0 + t) for t in np.arange(0, PERIOD, step)])


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_stays_where_the_arm_can_follow(name):
    places = way(name)
    assert (places >= (50, 10)).all()
    assert (places <= (150, 110)).all()


@pytest.mark.parametrize("name", FIGURES)
@pytest.mark.parametrize("field", ["right_4x4", "right_3x3"])
def test_a_figure_crosses_borders_of_areas_but_never_runs_along_one(name, field):
    places = way(name)
    edges = bench("learn-map", f"field={field}").field.edges
    for axis, borders in enumerate(edges):
        near = np.abs(places[:, axis, None] - borders[1:-1]).min(axis=1) < 2.0
        beginnings = np.flatnonzero(np.diff(near.astype(int), prepend=0) == 1)
        ends = np.flatnonzero(np.diff(near.astype(int), append=0) == -1)
        assert (ends - beginnings < 0.1 * len(places)).all()


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_begins_after_a_rest_and_comes_back_after_each_lap(name):
    gesture = gesture_of(name, f"demonstrator.period={PERIOD}")
    start = gesture.place(0.0)
    assert gesture.place(1.0) == pytest.approx(start)
    assert np.linalg.norm(gesture.place(1.0 + PERIOD / 3) - start) > 20
    assert gesture.place(1.0 + 5 * PERIOD) == pytest.approx(start, abs=1e-6)


def test_after_its_laps_the_hand_rests():
    gesture = gesture_of("circle", "demonstrator.laps=2")
    places = [gesture.place(33.0 + later) for later in (0.0, 3.0, 99.0)]
    assert places == [pytest.approx(gesture.place(0.0))] * 3


def test_a_square_visits_its_corners_and_rests_at_each():
    gesture = gesture_of("square", "demonstrator.period=4", "demonstrator.start=0")
    corners = [gesture.place(float(second)).tolist() for second in range(4)]
    assert corners == [[55, 45], [115, 45], [115, 105], [55, 105]]
    assert np.linalg.norm(gesture.place(1.02) - gesture.place(1.0)) < 0.2


def test_a_waypoint_is_reached_at_its_time_and_left_smoothly():
    gesture = waypoints([[1, 50, 50], [2, 50, 50], [4, 90, 50]], stays=True)
    assert gesture.place(0.9) is None
    assert gesture.place(1.5).tolist() == [50, 50]
    assert gesture.place(2.1)[0] - 50 < 1.0  # at an even pace it would be 2
    assert gesture.place(3.0) == pytest.approx([70, 50])
    assert gesture.place(60.0).tolist() == [90, 50]


def test_a_hand_that_does_not_stay_is_gone_after_its_last_waypoint():
    gesture = waypoints([[0, 50, 50], [2, 90, 50]], stays=False)
    assert gesture.place(2.0).tolist() == [90, 50]
    assert gesture.place(2.1) is None


def test_waypoints_out_of_order_are_refused():
    with pytest.raises(ValueError, match="times must ascend"):
        waypoints([[0, 50, 50], [3, 90, 50], [2, 60, 50]], stays=True)


def test_the_can_is_carried_from_where_it_is_taken_to_where_it_is_let_go():
    gesture = pick_and_place([[20, 75], [85, 75], [115, 45], [145, 75]], [1, 1, 1, 1], 2, [9, 200])
    told = [(gesture.place(t).tolist(), gesture.carries(t)) for t in (0.5, 3.5, 6.5, 9.5)]
    assert told == [([20, 75], False), ([85, 75], True), ([115, 45], True), ([145, 75], False)]
    assert gesture.place(12.1) is None


def test_pick_and_place_shows_its_states_in_other_areas_far_from_their_borders():
    field = bench("learn-map").field
    places = bench("learn-map", "demonstrator=pick_and_place").cfg["demonstrator"]["places"]
    areas = [field.area_of(np.array(place)) for place in places]
    assert len(set(areas)) == 4
    assert [area[1] == 0 for area in areas] == [True, False, False, False]
    for place in places:
        for axis, borders in enumerate(field.edges):
            assert np.abs(borders - place[axis]).min() >= 10


def test_a_trigger_appears_where_pick_and_place_begins_and_stays_unless_told_to_leave():
    first = gesture_of("pick_and_place").place(0.0)
    gesture = gesture_of("trigger")
    assert gesture.place(0.9) is None
    assert gesture.place(1.0).tolist() == gesture.place(99.0).tolist() == first.tolist()
    brief = trigger([60, 60], at=1.0, stay=0.5)
    assert [brief.place(t) is None for t in (0.9, 1.0, 1.5, 1.6)] == [True, False, False, True]


def test_two_waypoints_are_joined_without_leaving_their_straight_line():
    path = Waypoints(np.array([0.0, 1.0]), np.array([[0.0, 0.0], [30.0, 60.0]]), stays=True)
    along = np.array([path.place(t) for t in np.linspace(0, 1, 20)])
    assert along[:, 1] == pytest.approx(2 * along[:, 0])
    assert (np.diff(along[:, 0]) >= 0).all()
