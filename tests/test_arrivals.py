"""Which areas a hand has newly come to stay in."""

import numpy as np
import pytest

from imitation.arrivals import Arrivals, Noticing
from imitation.visual_field import VisualField
from imitation.visual_states import Resting

TICK = 0.04  # [s]
FIELD = VisualField("made_up", (160, 120), 3, 3, 40.0)  # areas of 40 px
RADIUS = 8.0  # of a hand [px]


def pixels(*hands) -> np.ndarray:
    """Those of round hands at places [px]."""
    x, y = np.meshgrid(np.arange(-RADIUS, RADIUS + 1), np.arange(-RADIUS, RADIUS + 1))
    disc = np.stack((x, y), axis=-1)[np.hypot(x, y) <= RADIUS]
    return np.concatenate([disc + place for place in hands] or [np.zeros((0, 2))])


def centre(area) -> np.ndarray:
    return FIELD.centres[area]


class Watch:
    """Watches for stretches of time and keeps what arrived."""

    def __init__(self) -> None:
        resting = Resting(dwell=0.3, still=4.0, hysteresis=0.3, lost=0.2)
        noticing = Noticing(appearing=0.2, leaving=0.1, absence=0.5, one_hand=20.0)
        self.arrivals = Arrivals(resting, noticing, FIELD.reachable)
        self.time, self.told = 0.0, []

    def sees(self, seconds, *areas) -> list:
        """What arrives while hands are in the middle of `areas` for `seconds`."""
        return self.shown(seconds, lambda _: [centre(area) for area in areas])

    def shown(self, seconds, hands) -> list:
        """What arrives while hands are where `hands(time)` says [px] for `seconds`."""
        before, begun = len(self.told), self.time
        for _ in range(round(seconds / TICK)):
            seen = pixels(*hands(self.time - begun))
            activity, places = FIELD.activity(seen), FIELD.mean_places(seen)
            self.told += self.arrivals.notice(self.time, activity, places).items()
            self.time += TICK
        return [area for area, _ in self.told[before:]]


def test_a_hand_that_comes_and_stays_arrives_once():
    watch = Watch()
    assert watch.sees(1.0) == []
    assert watch.sees(5.0, (1, 2)) == [(1, 2)]


def test_it_is_told_since_when_the_hand_is_there():
    watch = Watch()
    watch.sees(1.0)
    watch.sees(1.0, (1, 2))
    [(_, since)] = watch.told
    assert abs(since - 1.0) <= TICK


def test_what_is_there_from_the_start_is_no_arrival():
    assert Watch().sees(10.0, (1, 2)) == []


def test_where_the_own_hand_cannot_be_a_hand_is_news_from_the_start():
    watch = Watch()
    assert watch.sees(1.0, (1, 0), (2, 2)) == [(1, 0)]
    assert watch.told[0][1] == 0.0


@pytest.mark.parametrize("speed", [40.0, 100.0, 300.0])  # [px/s]
def test_a_hand_that_only_passes_does_not_arrive(speed):
    watch = Watch()
    watch.sees(1.0)
    assert watch.shown(160 / speed, lambda time: [np.array((speed * time, 65.0))]) == []


def test_a_hand_that_comes_to_rest_arrives_since_it_came_into_the_area():
    watch = Watch()
    watch.sees(1.0)
    watch.shown(2.0, lambda time: [np.array((min(50 + 40 * time, 100), 65.0))])
    [(area, since)] = watch.told
    assert area == (1, 2)
    assert abs(since - 1.75) <= 2 * TICK  # it crosses x = 80 px


@pytest.mark.parametrize("beyond", [-3.0, -1.0, 1.0, 3.0])  # the border [px]
def test_a_hand_near_a_border_arrives_in_the_area_that_shows_most_of_it_alone(beyond):
    watch = Watch()
    watch.sees(1.0)
    arrived = watch.shown(3.0, lambda _: [np.array((80.0 + beyond, 65.0))])
    assert arrived == [(1, 2) if beyond > 0 else (1, 1)]


def test_a_second_hand_arrives_in_the_area_beside_one_that_stays():
    watch = Watch()
    watch.sees(1.0, (1, 2))
    assert watch.sees(1.0, (1, 2), (1, 3)) == [(1, 3)]


def test_a_second_hand_arrives_beside_one_that_was_there():
    watch = Watch()
    watch.sees(1.0, (0, 0))
    assert watch.sees(1.0, (0, 0), (2, 3)) == [(2, 3)]


def test_the_other_hands_leaving_makes_no_arrival_of_what_stays():
    watch = Watch()
    watch.sees(1.0, (0, 0), (2, 3))
    assert watch.sees(2.0, (0, 0)) == []


def test_a_hand_must_leave_before_it_can_arrive_again():
    watch = Watch()
    watch.sees(1.0)
    watch.sees(1.0, (1, 2))
    assert watch.sees(0.2) == []
    assert watch.sees(1.0, (1, 2)) == []  # gone too shortly
    watch.sees(1.0)
    assert watch.sees(1.0, (1, 2)) == [(1, 2)]


def test_a_hand_resting_on_a_border_arrives_once_in_spite_of_noise():
    watch, rng = Watch(), np.random.default_rng(0)
    watch.sees(1.0)
    middle = np.array((80.0, 65.0))
    assert len(watch.shown(20.0, lambda _: [middle + rng.standard_normal(2)])) == 1


def test_hands_taken_for_granted_do_not_arrive():
    watch = Watch()
    watch.sees(1.0)
    watch.sees(0.1, (1, 2))
    watch.arrivals.grow_familiar()
    assert watch.sees(2.0, (1, 2)) == []
