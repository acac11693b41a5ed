"""Mimicry: the arm goes where the hand it sees would be its own."""

import inspect

import numpy as np
import pytest
from on_bench import bench

from cli.stages import mimicking
from imitation.stages import mimic as stage


@pytest.fixture(scope="module")
def learned(ideal_lesson):
    return ideal_lesson.learner.learned


def mimicked(learned, *words: str) -> list:
    """The samples of `imitate mimic WORDS`."""
    return list(mimicking(bench("mimic", "robot=ideal", *words), learned))


def resting_at(place, *words: str) -> tuple[str, ...]:
    """A demonstrator whose hand rests at `place` [px]."""
    x, y = place
    told = f"demonstrator.waypoints=[[0,{x},{y}],[1,{x},{y}]]"
    return ("demonstrator=waypoints", told, "camera.noise_px=0", *words)


@pytest.mark.parametrize("area", [(2, 1), (0, 4), (3, 3)])
def test_mimicking_ends_in_the_posture_learned_where_the_hand_is_seen(learned, area):
    centre = learned.field.centres[area]
    samples = mimicked(learned, *resting_at(centre, "duration=5"))
    assert samples[-1].seen.posture == pytest.approx(learned.postures[(*area, 0)], abs=0.01)
    assert np.abs(samples[-1].seen.velocity).max() < 0.01


def test_soft_selection_brings_the_own_hand_to_where_the_other_one_is(ideal_lesson, learned):
    place = np.array([101.0, 62.0])  # near the corner of four areas
    samples = mimicked(learned, *resting_at(place, "duration=5", "selection=soft"))
    shown = ideal_lesson.truly_shown(samples[-1].seen.posture)
    assert np.linalg.norm(shown - place) < 5
    assert np.sort(samples[-1].decision.selection, axis=None)[-4:].min() > 0.1
    assert samples[-1].decision.index.tolist() == [[-1, -1, -1]]


@pytest.mark.parametrize("selection", ["winner", "soft"])
def test_with_no_hand_in_view_the_arm_rests(learned, selection):
    samples = mimicked(learned, "demonstrator=none", "duration=2", f"selection={selection}")
    after_the_turn = samples[2:]
    assert all(sample.percept.hand is None for sample in after_the_turn)
    assert after_the_turn[-1].seen.posture == pytest.approx(samples[0].seen.posture, abs=0.02)


@pytest.mark.parametrize("selection", ["winner", "soft"])
def test_a_hand_where_nothing_was_learned_selects_nothing(learned, selection):
    words = resting_at((20, 60), "duration=2", f"selection={selection}")
    samples = mimicked(learned, *words)
    assert samples[-1].decision.selection[:, 0].sum() == 1
    assert not len(samples[-1].decision.postures)
    assert not samples[-1].seen.velocity.any()


def test_the_neck_turns_until_the_own_hand_is_out_of_view(learned):
    parts = bench("mimic", "robot=ideal", "demonstrator=none", "duration=1")
    samples = list(mimicking(parts, learned))
    assert samples[0].percept.hand is not None
    assert samples[-1].seen.gaze == pytest.approx(parts.space.reference)
    assert samples[-1].percept.hand is None


@pytest.mark.parametrize("look", ["tag", "skin"])
def test_only_a_hand_that_looks_like_the_own_one_is_followed(learned, look):
    words = ("demonstrator=line", f"demonstrator.hand={look}", "duration=6")
    postures = np.array([sample.seen.posture for sample in mimicked(learned, *words)])
    assert (np.ptp(postures, axis=0).max() > 0.2) == (look == "tag")


def test_the_stage_knows_of_no_demonstrator():
    assert "demonstrator" not in inspect.getsource(stage).lower()


def test_it_lasts_as_long_as_was_asked(learned):
    assert len(mimicked(learned, "duration=2")) == 50
    assert len(mimicked(learned, "mimic.endless=3")) == 75
