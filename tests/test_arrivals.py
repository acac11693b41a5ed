"""Which areas a hand has newly come to stay in."""

import numpy as np

from imitation.arrivals import Arrivals

TICK = 0.04  # [s]


def seen_in(*areas) -> np.ndarray:
    """Visual input of hands of equal size."""
    visual_input = np.zeros((3, 4))
    for area in areas:
        visual_input[area] += 1 / len(areas)
    return visual_input


class Watch:
    """Watches for stretches of time and keeps what arrived."""

    def __init__(self) -> None:
        self.arrivals = Arrivals(appearing=0.2, leaving=0.1, dwell=0.3, absence=0.5)
        self.time, self.told = 0.0, []

    def sees(self, seconds, *areas) -> list:
        """What arrives while hands are in `areas` for `seconds`."""
        before = len(self.told)
        for _ in range(round(seconds / TICK)):
            for area, since in self.arrivals.notice(self.time, seen_in(*areas)).items():
                self.told.append((area, since))
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


def test_a_hand_that_only_passes_does_not_arrive():
    watch = Watch()
    watch.sees(1.0)
    passed = [area for column in range(4) for area in watch.sees(0.2, (1, column))]
    assert passed == []


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
    told = []
    for _ in range(500):
        share = 0.2 + 0.08 * rng.standard_normal()
        visual_input = np.zeros((3, 4))
        visual_input[1, 1:3] = share, 1 - share
        told += watch.arrivals.notice(watch.time, visual_input)
        watch.time += TICK
    assert sorted(told) == [(1, 1), (1, 2)]


def test_hands_taken_for_granted_do_not_arrive():
    watch = Watch()
    watch.sees(1.0)
    watch.sees(0.1, (1, 2))
    watch.arrivals.grow_familiar()
    assert watch.sees(2.0, (1, 2)) == []
