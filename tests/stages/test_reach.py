"""Reaching seen targets with the map that the ideal arm learned."""

from itertools import pairwise

import numpy as np
import pytest
from on_bench import bench, lesson

from cli.stages import reaching
from imitation.stages.reach import Trial
from imitation.stages.trials import from_learned_postures, random_targets

PERIOD = 0.04  # [s]


@pytest.fixture(scope="module")
def learned(ideal_lesson):
    return ideal_lesson.learner.learned


def random_trials(lesson, count: int, seed: int = 7) -> list[Trial]:
    rng = np.random.default_rng(seed)
    targets = random_targets(lesson.stored.outline, (160, 120), 6.0, count, rng)
    return from_learned_postures(targets, lesson.learner.learned, rng)


def reached(learned, trials, *words: str) -> list:
    """The samples of `imitate reach WORDS` for these trials."""
    return list(reaching(bench("reach", "robot=ideal", *words), learned, trials))


def by_trial(samples) -> list[list]:
    """The samples of each trial."""
    begins = [i for i, sample in enumerate(samples) if sample.events[:1] and begun(sample)]
    return [samples[a:b] for a, b in pairwise([*begins, len(samples)])]


def begun(sample) -> bool:
    return sample.events[0].kind == "episode"


def told(samples) -> list[str]:
    return [event.kind for sample in samples for event in sample.events]


@pytest.mark.parametrize("delay", [0, 5])
def test_the_corrected_aim_holds_random_targets_however_late_the_frames(ideal_lesson, delay):
    learned, trials = ideal_lesson.learner.learned, random_trials(ideal_lesson, 12)
    samples = reached(learned, trials, f"camera.delay_frames={delay}")
    for trial, steps in zip(trials, by_trial(samples), strict=True):
        assert told(steps)[-1] == "held"
        assert steps[-1].seen.time - steps[0].seen.time < 5.0
        shown = ideal_lesson.truly_shown(steps[-1].seen.posture)
        assert np.linalg.norm(shown - trial.target) < 3.0


def test_the_corrected_aim_holds_a_target_in_the_engine(ideal_lesson):
    trials = random_trials(ideal_lesson, 3)
    parts = bench("reach", "robot=katana_sim")
    samples = list(reaching(parts, ideal_lesson.learner.learned, trials))
    assert told(samples).count("held") == 3
    parts.robot.close()


def test_a_small_arm_of_five_servos_holds_targets_with_the_map_it_learned():
    learnt = lesson("robot=so101_sim")
    parts = bench("reach", "robot=so101_sim")
    samples = list(reaching(parts, learnt.learner.learned, random_trials(learnt, 3)))
    assert told(samples).count("held") == 3
    for robot in (parts.robot, learnt.bench.robot):
        robot.close()


def test_every_trial_tells_its_episode_then_reached_then_settled_then_held(ideal_lesson, learned):
    samples = reached(learned, random_trials(ideal_lesson, 6))
    for number, steps in enumerate(by_trial(samples)):
        kinds = told(steps)
        assert list(dict.fromkeys(kinds)) == ["episode", "reached", "settled", "held"]
        assert kinds.count("settled") == len(kinds) - 3  # a hold may have to begin anew
        assert {event.facts["trial"] for sample in steps for event in sample.events} == {number}


def test_a_trial_begins_at_rest_in_its_start_posture(ideal_lesson, learned):
    trials = random_trials(ideal_lesson, 3)
    for trial, steps in zip(trials, by_trial(reached(learned, trials)), strict=True):
        assert steps[0].seen.posture == pytest.approx(trial.start)
        assert not steps[0].seen.velocity.any()
        assert steps[0].events[0].facts["start_posture"] == trial.start.tolist()


def test_time_goes_on_from_one_trial_to_the_next(ideal_lesson, learned):
    samples = reached(learned, random_trials(ideal_lesson, 3))
    times = [sample.seen.time_ns for sample in samples]
    gaps = [after - before for before, after in pairwise(times)]
    assert min(gaps) == 40_000_000
    assert max(gaps) == 80_000_000  # the new start posture is sensed one tick later


def held_at(samples) -> list[int]:
    return [i for i, sample in enumerate(samples) if "held" in told([sample])]


def test_a_hold_is_as_many_frames_in_a_row_under_the_tolerance_as_asked(ideal_lesson, learned):
    samples = reached(learned, random_trials(ideal_lesson, 4), "reach.hold_frames=7")
    for end in held_at(samples):
        distances = [one.decision.distance for one in samples[end - 6 : end + 1]]
        assert max(distances) < 3.0
        assert "settled" in told([samples[end - 6]])


@pytest.mark.parametrize("noise", [0.0, 0.5])
def test_a_hold_begins_with_the_first_frame_in_a_row_unless_noise_may_have_put_it_there(
    ideal_lesson, learned, noise
):
    samples = reached(learned, random_trials(ideal_lesson, 12), f"camera.noise_px={noise}")
    early = 0
    for end in held_at(samples):
        before, first = samples[end - 10 : end - 8]
        assert "settled" in told([first])
        if before.decision.distance < 3.0:
            early += 1
            assert before.decision.distance >= 3.0 - 2 * noise
            assert samples[end - 11].decision.distance >= 3.0
    assert (early > 0) == (noise > 0)


def test_a_frame_seen_twice_counts_once_in_a_hold(learned):
    centre = learned.places[1, 2, 0]
    start = learned.postures[1, 2, 0]  # the hand is there from the first
    for delay, frames in ((0, 10), (5, 15)):
        words = ("camera.noise_px=0", f"camera.delay_frames={delay}")
        samples = reached(learned, [Trial(centre, start)], *words)
        assert len(samples) == frames


def test_a_trial_that_does_not_hold_ends_at_the_limit(learned):
    target, start = learned.places[0, 1, 0] + (14.0, 0.0), learned.postures[3, 4, 0]
    samples = reached(learned, [Trial(target, start)] * 2, "controller=nearest", "reach.limit=2")
    for steps in by_trial(samples):
        assert "held" not in told(steps)
        assert steps[-1].seen.time - steps[0].seen.time == pytest.approx(2.0)


def test_nearest_comes_to_rest_at_the_nearest_learned_posture_without_swinging(learned):
    target, start = learned.places[0, 2, 0] + (8.0, 6.0), learned.postures[3, 4, 0]
    samples = reached(learned, [Trial(target, start)], "controller=nearest", "reach.limit=3")
    goal, way = learned.postures[0, 2, 0], learned.postures[0, 2, 0] - start
    assert samples[-1].seen.posture == pytest.approx(goal, abs=1e-3)
    assert samples[-1].decision.distance == pytest.approx(10.0, abs=3.0)
    assert max((sample.seen.posture - goal) @ way for sample in samples) < 1e-3


def test_noise_pulls_never_and_moves_all_the_same(ideal_lesson, learned):
    (trial,) = random_trials(ideal_lesson, 1)
    samples = reached(learned, [trial], "controller=noise", "reach.limit=2")
    assert {sample.decision.gain for sample in samples} == {0.0}
    assert all(sample.decision.noise.any() for sample in samples)
    assert np.ptp([sample.seen.posture for sample in samples], axis=0).max() > 0.005


def after_reaching(samples) -> list:
    (first,) = (i for i, sample in enumerate(samples) if "reached" in told([sample]))
    return samples[first:]


def test_yuragi_stops_for_good_where_it_arrives(ideal_lesson, learned):
    for steps in by_trial(reached(learned, random_trials(ideal_lesson, 5), "controller=yuragi")):
        stopped = after_reaching(steps)
        assert all(not sample.command.velocity.any() for sample in stopped)
        assert (
            len(stopped) == 11
        )  # as many frames as make a hold, after one that noise may have put there
        speeds = [np.abs(sample.applied.sent).max() for sample in stopped]
        assert speeds == sorted(speeds, reverse=True)


def test_yuragi_stops_though_noise_in_the_camera_shows_the_hand_elsewhere(ideal_lesson, learned):
    (trial,) = random_trials(ideal_lesson, 1)
    words = ("controller=yuragi", "camera.noise_px=3")
    stopped = after_reaching(reached(learned, [trial], *words))
    assert max(sample.decision.distance for sample in stopped) > 3.0
    assert all(not sample.command.velocity.any() for sample in stopped)


def test_yuragi_told_to_hold_resumes_when_the_hand_drifts_out(ideal_lesson, learned):
    (trial,) = random_trials(ideal_lesson, 1)
    words = ("controller=yuragi", "reach.after=hold", "camera.noise_px=3", "reach.limit=20")
    held = after_reaching(reached(learned, [trial], *words))
    near = np.array([sample.decision.distance < 3.0 for sample in held])
    moved = np.array([bool(sample.command.velocity.any()) for sample in held])
    assert (moved == ~near).all()
    assert 10 < near.sum() < len(held) - 10


def test_towards_a_place_where_nothing_is_learned_the_arm_is_still_and_silent(learned):
    start = learned.postures[1, 2, 0]
    for controller in ("yuragi", "noise"):
        words = (f"controller={controller}", "reach.limit=1")
        samples = reached(learned, [Trial(np.array([20.0, 60.0]), start)], *words)
        assert told(samples) == ["episode"]
        for sample in samples:
            assert not sample.decision.noise.any()
            assert not sample.applied.sent.any()
        assert samples[-1].seen.posture == pytest.approx(start)


def test_a_learned_posture_is_reached_by_yuragi_and_by_the_corrected_aim(learned):
    trials = [
        Trial(learned.places[area], learned.postures[3 - area[0], 5 - area[1], 0])
        for area in ((0, 1, 0), (1, 3, 0), (2, 2, 0), (3, 4, 0))
    ]
    for controller in ("yuragi", "corrected_aim"):
        samples = reached(learned, trials, f"controller={controller}")
        assert told(samples).count("reached") == 4


def test_the_same_seed_reaches_in_the_same_way(ideal_lesson, learned):
    trials = random_trials(ideal_lesson, 2)
    both = [reached(learned, trials, "controller=yuragi") for _ in range(2)]
    for one, other in zip(*both, strict=True):
        assert one.seen.posture.tobytes() == other.seen.posture.tobytes()
        assert one.decision.noise.tobytes() == other.decision.noise.tobytes()


def test_random_targets_lie_where_the_hand_was_seen_and_in_the_image(ideal_lesson):
    targets = np.array([trial.target for trial in random_trials(ideal_lesson, 100)])
    assert (targets >= (40.0, 6.0)).all()
    assert (targets <= (154.0, 114.0)).all()


def test_a_trial_never_begins_at_the_posture_learned_nearest_to_its_target(ideal_lesson, learned):
    postures, places = learned.memories()
    for trial in random_trials(ideal_lesson, 100):
        nearest = np.argmin(np.linalg.norm(places - trial.target, axis=1))
        assert not np.array_equal(trial.start, postures[nearest])


def test_a_learned_region_without_extent_gives_no_targets():
    line = np.array([[50.0, 50.0], [60.0, 60.0]])
    with pytest.raises(ValueError, match="too small"):
        random_targets(line, (160, 120), 6.0, 1, np.random.default_rng(0))


def test_a_map_of_a_single_posture_gives_no_trials(ideal_lesson):
    poor = ideal_lesson.bench.empty_map()
    poor.postures[1, 2, 0], poor.places[1, 2, 0] = ideal_lesson.bench.guided[0], (100.0, 60.0)
    with pytest.raises(ValueError, match="holds 1 learned"):
        from_learned_postures([np.array([90.0, 50.0])], poor, np.random.default_rng(0))
