"""What triggers an action, and how it then plays."""

import numpy as np
import pytest

from imitation.arrivals import Arrivals, Noticing
from imitation.perception import Percept
from imitation.recall import Recall
from imitation.sequence import Replay, TimeCells, TimedSequence
from imitation.visual_field import VisualField
from imitation.visual_states import Resting

FIELD = VisualField("right_4x4", (160, 120), 4, 4, 40.0)
TICK = 0.04  # [s]
PLACES = [np.array(place) for place in ((20.0, 75.0), (85.0, 75.0), (115.0, 45.0), (145.0, 75.0))]
TIMES = [0.0, 2.0, 5.0, 7.5]  # [s]


def recall(places=PLACES) -> Recall:
    sequence = TimedSequence(TimeCells(0.2, 20.0, 20, 0.35), context=1, match=0.85)
    for place, time in zip(places, TIMES, strict=True):
        sequence.learn(FIELD.area_of(place), time)
    resting = Resting(dwell=0.3, still=4.0, hysteresis=0.3, lost=0.2)
    noticing = Noticing(appearing=0.2, leaving=0.1, absence=0.5, one_hand=20.0)
    arrivals = Arrivals(resting, noticing, FIELD.reachable)
    rng = np.random.default_rng(0)
    return Recall(places, Replay(sequence, TICK), arrivals, FIELD, noise=0.0, rng=rng)


class Scene:
    """Time passes before a recall, with hands at places."""

    def __init__(self, places=PLACES) -> None:
        self.recall, self.time, self.events = recall(places), 0.0, []

    def shows(self, seconds, *hands) -> list[str]:
        """Kinds of what happens while `hands` are at places [px] for `seconds`."""
        before = len(self.events)
        for _ in range(round(seconds / TICK)):
            seen = np.array(hands).reshape(-1, 2)
            activity, places = FIELD.activity(seen), FIELD.mean_places(seen)
            told = self.recall.notice(
                Percept(round(self.time * 1e9), None, activity, places, np.empty((0, 2)))
            )
            predicted = self.recall.predict(self.time)
            told += [predicted] if predicted else []
            self.events += [(self.time, event) for event in told if event.kind != "noticed"]
            self.time += TICK
        return [event.kind for _, event in self.events[before:]]


def test_a_hand_at_the_first_state_lets_all_others_follow_in_their_time():
    scene = Scene()
    scene.shows(1.0)
    assert scene.shows(10.0, PLACES[0]) == ["trigger", "predicted", "predicted", "predicted"]
    assert [event.facts["state"] for _, event in scene.events] == [0, 1, 2, 3]
    due = [time for time, event in scene.events if event.kind == "predicted"]
    began = scene.events[0][1].facts["since_s"]
    assert np.diff([began, *due]) == pytest.approx(np.diff(TIMES), abs=TICK + 0.02 * 3.0)


@pytest.mark.parametrize("state", [1, 2])
def test_a_hand_at_a_later_state_lets_those_after_it_follow(state):
    scene = Scene()
    scene.shows(1.0)
    assert scene.shows(10.0, PLACES[state]) == ["trigger", *["predicted"] * (3 - state)]


def test_a_hand_at_the_last_state_triggers_nothing():
    scene = Scene()
    scene.shows(1.0)
    assert scene.shows(5.0, PLACES[3]) == []


def test_hands_anywhere_else_trigger_nothing():
    states = {FIELD.area_of(place) for place in PLACES[:-1]}
    for (row, column), _ in np.ndenumerate(FIELD.reachable):
        scene = Scene()
        scene.shows(1.0)
        triggered = "trigger" in scene.shows(2.0, FIELD.centres[row, column])
        assert triggered == ((row, column) in states)


def test_within_reach_a_hand_that_was_there_from_the_start_triggers_nothing():
    assert Scene().shows(10.0, PLACES[1]) == []


def test_a_hand_that_was_there_from_the_start_triggers_where_the_arm_cannot_be():
    assert Scene().shows(10.0, PLACES[0])[0] == "trigger"


def test_while_the_action_plays_no_hand_triggers():
    scene = Scene()
    scene.shows(1.0)
    scene.shows(1.0, PLACES[0])
    assert scene.shows(10.0, PLACES[0], PLACES[1]).count("trigger") == 0


def test_a_hand_that_stays_does_not_trigger_again_but_one_that_comes_again_does():
    scene = Scene()
    scene.shows(1.0)
    scene.shows(10.0, PLACES[0])
    scene.recall.end()
    assert scene.shows(10.0, PLACES[0]) == []
    scene.shows(1.0)
    assert scene.shows(1.0, PLACES[0]) == ["trigger"]


def test_what_is_in_view_when_the_action_ends_does_not_trigger():
    scene = Scene()
    scene.shows(1.0)
    scene.shows(8.0, PLACES[0])
    scene.shows(0.1, PLACES[1])  # the robot's own hand, for all it knows
    scene.recall.end()
    assert scene.shows(5.0, PLACES[1]) == []


def test_states_are_the_areas_of_the_map_that_hold_their_places():
    coarse = VisualField("right_3x3", (160, 120), 3, 3, 40.0)
    one = recall()
    other = Recall(PLACES, one.loop, one.arrivals, coarse, 0.0, np.random.default_rng(0))
    assert other.areas == [(1, 0), (1, 2), (1, 2), (1, 3)]
