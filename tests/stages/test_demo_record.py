"""A demonstration is watched at rest and becomes visual states, online."""

import numpy as np
import pytest
from on_bench import bench

from cli.stages import watching


def watched(*words, seed=0):
    """The states found in `imitate demo-record robot=ideal WORDS`, and its samples."""
    found, samples = watching(bench("demo-record", "robot=ideal", *words, seed=seed))
    return found.states, list(samples)


@pytest.fixture(scope="module")
def shown():
    """The action of section IV."""
    return watched()


def events(samples):
    return [(sample.seen.time, event) for sample in samples for event in sample.events]


def test_an_action_has_four_states(shown):
    states, _ = shown
    assert [state.area for state in states] == [(2, 0), (2, 2), (1, 3), (2, 4)]


def test_each_state_is_told_while_the_hand_rests_there(shown):
    states, samples = shown
    told = events(samples)
    assert [event.facts["area"] for _, event in told] == [list(state.area) for state in states]
    for (time, _), state in zip(told, states, strict=True):
        assert state.time + 0.3 < time < state.time + 1.5


def test_the_arm_rests_all_the_while(shown):
    _, samples = shown
    postures = np.array([sample.seen.posture for sample in samples])
    assert np.ptp(postures, axis=0).max() < 1e-9
    assert all(not sample.command.velocity.any() for sample in samples)
    assert all(not len(sample.decision.postures) for sample in samples)


def test_the_selection_is_the_winning_area(shown):
    states, samples = shown
    told = [sample for sample in samples if sample.events]
    for state, sample in zip(states, told, strict=True):
        assert sample.decision.selection[state.area] == 1
        assert sample.decision.selection.sum() == 1


def test_it_ends_when_the_hand_is_gone(shown):
    _, samples = shown
    seen = [sample.seen.time for sample in samples if sample.percept.hand is not None]
    assert samples[-1].seen.time == pytest.approx(seen[-1] + 1.0, abs=0.09)


def test_it_ends_at_its_limit_when_there_is_no_action():
    states, samples = watched("demonstrator=none", "demo.duration=2")
    assert states == []
    assert len(samples) == 50
