"""What is told of a hand in view: that it is gone, back, or in two pieces."""

from dataclasses import replace
from itertools import chain

import numpy as np
import pytest
from recording.made_up import run

from imitation.hand_watch import HandWatch
from imitation.sample import Event

(STEP, _), *_ = run(1)
NOWHERE = np.empty((0, 2))
SECOND = 1_000_000_000


def watch() -> HandWatch:
    return HandWatch(after=0.5, gap=10.0, least=0.2)


def disc(x: float, y: float, radius: float = 6.0) -> np.ndarray:
    """Places of a round mark, (n, 2) [px]."""
    rows, columns = np.indices((120, 160)) + 0.5
    return np.argwhere((columns - x) ** 2 + (rows - y) ** 2 < radius**2)[:, ::-1] + 0.5


def events(*seen: tuple[float, np.ndarray]) -> list[Event]:
    """What is told when this is seen, each for so long [s]."""
    one, told = watch(), list[Event]()
    views = chain.from_iterable([pixels] * round(lasts * 25) for lasts, pixels in seen)
    for step, pixels in enumerate(views):
        percept = replace(STEP.percept, pixels=pixels)
        now = replace(STEP.seen, time_ns=step * SECOND // 25)
        told += one.noticed(replace(STEP, seen=now, percept=percept, events=())).events
    return told


def test_a_hand_that_stays_in_view_is_not_told_of():
    assert not events((2, disc(80, 60)), (2, disc(120, 60)))


def test_a_hand_that_goes_and_comes_back_is_told_of_once_each():
    told = events((1, disc(80, 60)), (3, NOWHERE), (3, disc(80, 60)))
    assert [one.sentence for one in told] == ["no hand is seen any more", "a hand is seen again"]


def test_a_hand_that_flickers_is_not_told_of():
    assert not events(*[(0.3, disc(80, 60)), (0.3, NOWHERE)] * 5)


def test_two_pieces_are_told_with_how_far_apart_they_are():
    two = np.concatenate((disc(60, 40), disc(100, 70)))
    parted, whole = events((1, disc(60, 40)), (2, two), (1, disc(100, 70)))
    assert parted.facts == {"pieces": 2, "apart_px": 50.0}
    assert "in two pieces, 50 px apart" in parted.sentence
    assert whole.facts == {"pieces": 1}


@pytest.mark.parametrize(
    "pixels",
    [
        np.concatenate((disc(60, 40), disc(100, 40, radius=1.5))),  # a speck beside it
        np.concatenate((disc(60, 40), disc(78, 40))),  # too near to be two
        disc(80, 60, radius=40.0),
        np.array([[80.5, 60.5]]),
    ],
)
def test_a_speck_or_a_small_gap_does_not_make_it_two(pixels):
    assert watch().apart(pixels) is None


def test_places_far_outside_the_image_are_no_burden():
    assert watch().apart(np.array([[0.0, 0.0], [1e12, 0.0]])) > 1e9
