"""Why the arm moved is said in words, with the numbers of the recording."""

import itertools

import numpy as np
import pytest

from cli.recompute import anew
from imitation.analysis.explanation import moment, reason
from imitation.recording.mcap_recording import Recording
from imitation.recording.recorded_steps import steps_told


@pytest.fixture(scope="module")
def run(ran, learned):
    """A short reach with noise: not to be changed."""
    words = ["reach.limit=1", "reach.required=0", "trials=2", "controller=yuragi"]
    return ran("reach", *words, f"map={learned}")


def reason_at(run, seconds):
    recording = Recording.open(run)
    when = moment(steps_told(recording), round(seconds * 1e9))
    return when, reason(when.told, recording.topics)


def test_the_step_under_way_is_explained(run):
    when, why = reason_at(run, 0.41)
    assert (when.number, why.seen.time) == (10, 0.4)
    assert when.episode.startswith("trial 1 begins")
    later, _ = reason_at(run, 1.2)
    assert later.episode.startswith("trial 2 begins") and later.episode_ns > 1e9


def test_shares_sum_to_one(run):
    _, why = reason_at(run, 0.4)
    assert len(why.shares) > 1
    assert why.shares.sum() == pytest.approx(1)
    assert why.activation.sum() == pytest.approx(1)


def test_pull_and_noise_make_up_what_was_requested(run):
    with anew(Recording.open(run)) as decided:
        dynamics = decided.bench.dynamics
    for seconds in (0.0, 0.3, 0.8):
        _, why = reason_at(run, seconds)
        parts = why.pulled(dynamics) + why.shaken(dynamics)
        assert parts == pytest.approx(why.requested, abs=1e-12)


def test_words_and_numbers_are_told(imitate, run):
    _, why = reason_at(run, 0.4)
    told = imitate("explain", str(run), "--at", "0.4")
    assert told.exit_code == 0, told.output
    for words in (
        "At 0.40 s, step 11",
        f"The hand is seen at ({why.hand[0]:.1f}, {why.hand[1]:.1f}) px",
        "The target is at",
        "selected:",
        f"gain A = {why.gain:.3g}",
        f"ε = {why.noise_level:.3g}",
        "The guard",
        f"{why.sent[0] + 0.0:+.3f}",
    ):
        assert words in told.stdout
    assert len(told.stdout.splitlines()) <= 40


def test_what_the_guard_took_away_is_told(imitate, run):
    when, why = reason_at(run, 0.0)
    assert np.any(why.limited != why.requested) and when.reasons == ("acceleration",)
    assert "(acceleration)" in imitate("explain", str(run), "--at", "0").stdout


def test_babbling_is_explained(imitate, learned):
    told = imitate("explain", str(learned), "--at", "2")
    assert told.exit_code == 0 and "a posture of its own" in told.stdout


@pytest.mark.parametrize(
    ("at", "told"), [("99", "type --at 2.08"), ("-1", "0 or later"), ("nan", "0 or later")]
)
def test_a_time_outside_the_run_is_one_line(imitate, run, at, told):
    result = imitate("explain", str(run), "--at", at)
    assert result.exit_code == 2
    assert told in result.stderr and len(result.stderr.splitlines()) == 1


def test_before_the_first_step_the_nearest_time_is_told(run):
    later = itertools.islice(steps_told(Recording.open(run)), 3, None)
    with pytest.raises(ValueError, match=r"begins at 0.12 s; type --at 0.12"):
        moment(later, 0)
