"""What becomes a visual state of a demonstration, and what does not."""

from itertools import pairwise

import numpy as np
import pytest

from imitation.visual_field import VisualField
from imitation.visual_states import Resting, VisualStates

FIELD = VisualField("right_4x4", (160, 120), rows=4, columns=4, left=40.0)
RESTING = Resting(dwell=0.4, still=4.0, hysteresis=0.3, lost=0.2)
PERIOD = 0.04  # [s]
DISC = np.array([(x, y) for x in range(-6, 7) for y in range(-6, 7) if x * x + y * y <= 36])
WAITING, TAKING, BY, LETTING_GO = (20, 75), (85, 75), (115, 45), (145, 75)


def rest(place, seconds):
    """A hand at rest, one place for each frame, (n, 2) [px]."""
    return np.tile(np.array(place, dtype=float), (round(seconds / PERIOD), 1))


def move(start, end, seconds):
    """A hand that moves evenly, (n, 2) [px]."""
    return np.linspace(start, end, round(seconds / PERIOD), dtype=float)


def unseen(seconds):
    """No hand in sight."""
    return np.full((round(seconds / PERIOD), 2), np.nan)


def action(slower=1.0):
    """The four rests of section IV with straight movements between them."""
    places = [WAITING, TAKING, BY, LETTING_GO]
    parts = [rest(WAITING, 1.5 * slower)]
    for start, end in pairwise(places):
        parts += [move(start, end, 1.2 * slower), rest(end, 1.5 * slower)]
    return parts


def watched(*parts, noise=0.5, seed=0, resting=RESTING):
    """The states found in what is seen of a hand whose place is told with `noise` [px]."""
    rng, states = np.random.default_rng(seed), VisualStates(resting, FIELD)
    for step, hand in enumerate(np.concatenate(parts)):
        seen = None if np.isnan(hand).any() else hand + rng.normal(0, noise, 2)
        pixels = np.zeros((0, 2)) if seen is None else DISC + seen
        states.see(step * PERIOD, FIELD.activity(pixels), seen)
    return states.states


@pytest.mark.parametrize("seed", range(5))
def test_an_action_is_the_places_where_the_hand_rests(seed):
    states = watched(*action(), seed=seed)
    assert [state.area for state in states] == [(2, 0), (2, 2), (1, 3), (2, 4)]
    for state, place in zip(states, [WAITING, TAKING, BY, LETTING_GO], strict=True):
        assert state.place == pytest.approx(place, abs=0.5)


def test_a_state_begins_when_its_area_does():
    first, second, *_ = watched(*action(), noise=0.0)
    assert first.time == 0
    way = (70 - 20) / (85 - 20)  # to the border of the area where it takes the can
    assert second.time == pytest.approx(1.5 + way * 1.2, abs=0.08)


@pytest.mark.parametrize("slower", [0.5, 2.0])
def test_the_same_states_are_found_when_shown_faster_or_slower(slower):
    states = watched(*action(slower))
    assert [state.area for state in states] == [(2, 0), (2, 2), (1, 3), (2, 4)]


@pytest.mark.parametrize("corner", [(100, 75), (100, 60), (115, 60), (40, 75)])
@pytest.mark.parametrize("noise", [0.5, 1.0])
def test_a_hand_that_rests_on_a_border_is_one_state(corner, noise):
    for seed in range(3):
        assert len(watched(rest(corner, 30), noise=noise, seed=seed)) == 1


def test_areas_that_are_crossed_without_stopping_are_none():
    states = watched(rest((20, 15), 1), move((20, 15), (145, 15), 5), rest((145, 15), 1))
    assert [state.area for state in states] == [(0, 0), (0, 4)]


def test_a_movement_along_a_border_is_none():
    assert watched(move((5, 60), (155, 60), 5)) == []


def test_a_hand_that_comes_back_to_where_it_was_makes_no_new_state():
    away = (move(TAKING, BY, 0.5), move(BY, TAKING, 0.5))
    assert len(watched(rest(TAKING, 1), *away, rest(TAKING, 1))) == 1


def test_an_area_visited_again_after_another_is_a_state_again():
    states = watched(
        rest(TAKING, 1), move(TAKING, BY, 0.5), rest(BY, 1), move(BY, TAKING, 0.5), rest(TAKING, 1)
    )
    assert [state.area for state in states] == [(2, 2), (1, 3), (2, 2)]


def test_a_hand_lost_for_a_moment_goes_on_resting_and_one_that_left_does_not():
    blink = rest(BY, 0.3), unseen(0.12), rest(BY, 0.3)
    (state,) = watched(*blink)
    assert state.time == 0
    assert watched(rest(BY, 0.3), unseen(1.0), rest(BY, 0.3)) == []


def test_a_hand_looked_at_seldom_has_not_left_meanwhile():
    states = VisualStates(RESTING, FIELD)
    for look in range(6):
        states.see(0.36 * look, FIELD.activity(DISC + BY), np.array(BY))
    assert [(state.area, state.time) for state in states.states] == [((1, 3), 0.0)]


def test_a_state_is_told_as_soon_as_the_hand_has_rested_long_enough():
    states = VisualStates(RESTING, FIELD)
    told = [
        step * PERIOD
        for step, hand in enumerate(rest(BY, 2))
        if states.see(step * PERIOD, FIELD.activity(DISC + hand), hand)
    ]
    assert told == [pytest.approx(RESTING.dwell, abs=PERIOD)]


def test_a_state_lies_in_its_area_however_far_what_is_seen_spreads():
    states, wide = VisualStates(RESTING, FIELD), np.zeros(FIELD.shape)
    for step, (there, here) in enumerate([(0.6, 0.4)] * 10 + [(0.4, 0.6)] * 20):
        wide[2, 2], wide[2, 1] = there, here
        states.see(step * PERIOD, wide, np.array((55, 75) if here > there else (85, 75)))
    assert [state.area for state in states.states] == [(2, 1)]


def test_no_hand_is_no_state():
    assert watched(unseen(3)) == []
