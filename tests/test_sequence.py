"""Discrete transition learning with timing, after paper section IV."""

import numpy as np
import pytest

from imitation.sequence import Replay, TimeCells, TimedSequence

TICK = 0.04  # [s]
CELLS = TimeCells(shortest=0.2, longest=20.0, count=20, width=0.35)
A, B, C = 0, 1, 2


def learned(states, times, context=1):
    """A sequence seen once."""
    sequence = TimedSequence(CELLS, context, match=0.85)
    for state, time in zip(states, times, strict=True):
        sequence.learn(state, time)
    return sequence


def played(sequence, start=0, noise=None, limit=100.0):
    """Index and time [s] of every state that is predicted, played from `start` at time 0."""
    replay = Replay(sequence, TICK)
    replay.start(start, 0.0, noise)
    found = []
    for step in range(1, round(limit / TICK)):
        index = replay.predict(step * TICK)
        if index is not None:
            found.append((index, step * TICK))
        if replay.over:
            break
    return found


def recalled(interval, noise=None):
    """When the second of two states `interval` [s] apart is predicted [s]."""
    ((_, time),) = played(learned([A, B], [0.0, interval]), noise=noise)
    return time


@pytest.mark.parametrize("interval", np.geomspace(0.2, 20.0, 30))
def test_an_interval_seen_once_is_recalled_within_half_a_tick(interval):
    assert recalled(interval) == pytest.approx(interval, abs=0.5 * TICK + 1e-9)


@pytest.mark.parametrize("ticks", [5, 6, 7, 11, 25, 63, 250, 499])
def test_an_interval_of_whole_ticks_is_recalled_to_the_tick(ticks):
    assert recalled(ticks * TICK) == pytest.approx(ticks * TICK)


def test_errors_under_read_out_noise_are_proportional_to_the_interval():
    rng = np.random.default_rng(0)
    spread = []
    for interval in (1.0, 2.0, 4.0, 8.0, 16.0):
        noises = rng.normal(0, 0.1, (60, 2, CELLS.count))
        errors = [recalled(interval, noise) - interval for noise in noises]
        spread.append(np.std(errors) / interval)
    assert max(spread) < 1.5 * min(spread)
    assert np.mean(spread) == pytest.approx(0.03, abs=0.01)


def test_each_prediction_is_fed_back_until_the_sequence_ends():
    times = [3.0, 4.0, 6.6, 7.2]
    found = played(learned([A, B, C, A], times))
    assert [index for index, _ in found] == [1, 2, 3]
    assert [time for _, time in found] == pytest.approx([1.0, 3.6, 4.2])


def test_a_sequence_can_be_entered_at_any_of_its_states():
    sequence = learned([A, B, A, C], [0.0, 1.0, 3.0, 4.0])
    assert [index for index, _ in played(sequence, start=2)] == [3]
    assert played(sequence, start=3) == []


def test_a_state_that_comes_twice_is_followed_by_what_its_context_says():
    found = played(learned([A, B, A, C], [0.0, 1.0, 3.0, 4.0]))
    assert found == [(1, pytest.approx(1.0)), (2, pytest.approx(3.0)), (3, pytest.approx(4.0))]


def test_without_context_it_cannot_be_told_what_follows_a_state_that_comes_twice():
    with pytest.raises(ValueError, match=r"states 1 and 3 are the same.*sequence\.context=1"):
        learned([A, B, A, C], [0.0, 1.0, 3.0, 4.0], context=0)


def test_a_longer_repetition_needs_a_longer_context():
    states, times = [A, B, A, B, C], np.arange(5.0)
    with pytest.raises(ValueError, match=r"sequence\.context=2"):
        learned(states, times)
    assert [index for index, _ in played(learned(states, times, context=2))] == [1, 2, 3, 4]


@pytest.mark.parametrize("interval", [-1.0, 0.0, 0.1, 20.1, float("nan")])
def test_an_interval_that_the_time_cells_cannot_tell_is_refused(interval):
    with pytest.raises(ValueError, match=r"state 2 comes .* s after.*0\.2 to 20 s"):
        learned([A, B], [0.0, interval])


def test_nothing_is_predicted_before_its_time_however_early_one_asks():
    replay = Replay(learned([A, B], [0.0, 10.0]), TICK)
    replay.start(0, 0.0)
    assert all(replay.predict(step * TICK) is None for step in range(249))
