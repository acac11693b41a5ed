"""Reaches as the figures show them, and the places they reach for."""

import numpy as np
import pytest
from made_up_reaches import FIELD, learned_map, run, trial

from imitation.analysis.reached import (
    between_four,
    learned_positions,
    situation,
    typical,
    typical_of,
)


def test_four_attractors_take_part_at_a_corner_of_four_areas():
    four = between_four(learned_map(), radius=30.0, average=25.0)
    assert len(four.active) == 4
    assert four.distances == pytest.approx(np.full(4, np.hypot(20, 20)))


def test_the_corner_with_the_wished_distance_is_chosen():
    learned = learned_map()
    for area in ((1, 2), (1, 3), (2, 2), (2, 3)):  # these come nearer to their corner
        learned.places[area][0] += np.sign(np.array((120.0, 80.0)) - FIELD.centres[area]) * 2.0
    assert between_four(learned, 30.0, 25.0).target == pytest.approx([120.0, 80.0])


def test_no_place_lies_between_four_when_an_area_is_missing_at_each_corner():
    learned = learned_map()
    learned.postures[1, 2] = np.nan  # the middle one
    assert between_four(learned, 30.0, 25.0) is None


def test_two_attractors_take_part_at_a_place_learned_off_its_centre():
    assert learned_positions(learned_map(), 30.0, active=2) == []
    found = learned_positions(learned_map(np.array((12.0, 0.0))), 30.0, active=2)
    assert len(found) == 6  # of the last column, no neighbour is on that side
    assert all(len(one.active) == 2 for one in found)


def test_a_situation_tells_where_the_active_attractors_were_seen():
    there = situation(learned_map(), np.array((60.0, 20.0)), radius=30.0)
    assert there.active == ((0, 1),)
    assert there.distances == pytest.approx([0.0])


def test_a_trial_that_arrives_stops_there():
    arriving = trial((100.0, 60.0), (80.0, 60.0), seconds=2.0)
    assert arriving.stopped_px == pytest.approx(2.0)
    assert arriving.steps_until_reached == 11
    assert arriving.time_s == 2.0


def test_a_trial_that_never_arrives_counts_as_its_limit():
    lost = trial((100.0, 60.0), (80.0, 60.0), seconds=60.0, final=9.0)
    assert (lost.time_s, lost.time_to_hold_s) == (60.0, 60.0)
    assert lost.stopped_px == lost.final_px == pytest.approx(9.0)


def test_a_hand_out_of_view_at_the_end_leaves_the_last_distance_seen():
    lost = trial((100.0, 60.0), (80.0, 60.0), seconds=60.0, final=9.0)
    lost.distances[-1] = float("nan")
    assert lost.final_px == lost.distances[-2]


def test_the_typical_map_takes_the_median_time():
    runs = [run(paper_s=2.0), run(paper_s=9.0), run(paper_s=4.0)]
    assert typical(runs) is runs[2]
    assert typical([]) is None


def test_the_typical_position_takes_the_median_time():
    one, two, three = (run(paper_s=seconds).at_learned[0] for seconds in (2.0, 9.0, 4.0))
    assert typical_of([one, two, three]) is three
    assert typical_of([]) is None
