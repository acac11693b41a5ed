"""Deferred imitation on the ideal arm: what triggers, what follows, and what does not."""

import numpy as np
import pytest
from on_bench import lesson

from cli.build import Bench
from cli.deferred_runs import demonstrated, replayed
from cli.experiments import composed
from cli.jobs.replay import deferred_metrics
from cli.replaying import replaying
from imitation.robot import Truth

IDEAL = "robot=ideal"
IN_VIEW = "robot.rest=[0.154,1.076,-1.64,0.432,0.0]"  # shows the hand in the action's second area


@pytest.fixture(scope="module")
def action():
    """The action of section IV."""
    return demonstrated(0, IDEAL)


@pytest.fixture(scope="module")
def learned(ideal_lesson):
    """The ideal arm's map."""
    return ideal_lesson.learner.learned


class Told:
    """Keeps the events of a run and the largest joint speed."""

    def __init__(self) -> None:
        self.events, self.fastest, self.hands = [], 0.0, []

    def __call__(self, sample, bench) -> None:
        self.events += [(sample.seen.time, event) for event in sample.events]
        self.fastest = max(self.fastest, float(np.abs(sample.applied.sent).max()))

    def times_of(self, kind) -> list[float]:
        return [time for time, event in self.events if event.kind == kind]


def imitate(learned, action, *words, seed=0):
    """Metrics and events of `imitate replay robot=ideal WORDS`."""
    told = Told()
    return replayed(seed, learned, action, IDEAL, "~object", *words, look=told).result(), told


@pytest.mark.parametrize("precision", ["area", "seen"])
def test_a_hand_at_the_first_state_lets_the_whole_action_follow_in_order_and_time(
    learned, action, precision
):
    metrics, told = imitate(learned, action, f"replay.precision={precision}")
    assert metrics["order_correct"]
    assert metrics["states_replayed"] == 3
    assert max(map(abs, metrics["timing_error_s"])) < 0.5
    delays = np.diff([state.time for state in action.states])
    for error, delay in zip(metrics["clock_error_s"], delays, strict=True):
        assert abs(error) <= max(0.04, 0.02 * delay) + 1e-9
    assert len(told.times_of("trigger")) == 1


@pytest.mark.parametrize("state", [1, 2])
def test_a_hand_at_a_later_state_lets_what_follows_it_follow(learned, action, state):
    x, y = action.states[state].place
    metrics, _ = imitate(learned, action, f"demonstrator.place=[{x},{y}]")
    assert metrics["triggered_by_state"] == state
    assert metrics["order_correct"]
    assert metrics["states_replayed"] == 3 - state


@pytest.mark.parametrize("place", [[20, 15], [55, 15], [130, 105], [145, 75]])
def test_a_hand_elsewhere_triggers_nothing_and_the_arm_rests(learned, action, place):
    words = [f"demonstrator.place={place}".replace(" ", ""), "replay.patience=4"]
    metrics, told = imitate(learned, action, *words)
    assert metrics["triggered_at_s"] is None
    assert told.fastest == 0.0


@pytest.mark.parametrize("shown", ["demonstrator.at=0", "demonstrator=pick_and_place"])
def test_left_of_the_reach_a_hand_that_is_there_from_the_start_triggers(learned, action, shown):
    metrics, told = imitate(learned, action, shown)
    assert metrics["triggered_by_state"] == 0
    assert told.times_of("trigger") == [pytest.approx(0.4, abs=0.05)]
    assert metrics["order_correct"]


@pytest.mark.parametrize("state", [1, 2])
def test_within_reach_it_does_when_the_arm_rests_where_it_has_never_seen_its_own(
    learned, action, state
):
    x, y = action.states[state].place
    shown = [f"demonstrator.place=[{x},{y}]", "demonstrator.at=0", "replay.patience=4"]
    metrics, told = imitate(learned, action, *shown)
    assert metrics["triggered_by_state"] == state
    assert told.times_of("trigger") == [pytest.approx(0.4, abs=0.05)]
    assert metrics["order_correct"]
    metrics, _ = imitate(learned, action, *shown, IN_VIEW)
    assert metrics["triggered_at_s"] is None


def test_a_hand_that_only_passes_through_the_states_triggers_nothing(learned, action):
    y = action.states[0].place[1]
    shown = f"[[1,-60,{y}],[6,220,{y}]]"  # from beyond one edge of the image to beyond the other
    words = ["demonstrator=waypoints", f"demonstrator.waypoints={shown}", "replay.patience=6"]
    metrics, _ = imitate(learned, action, *words)
    assert metrics["triggered_at_s"] is None


def test_an_arm_that_rests_in_view_in_a_learned_state_triggers_nothing(learned, action):
    words = [IN_VIEW, "demonstrator=none", "replay.patience=4"]
    metrics, told = imitate(learned, action, *words)
    assert metrics["triggered_at_s"] is None
    assert told.fastest == 0.0


def test_an_arm_that_rests_in_a_learned_state_does_not_keep_a_hand_from_triggering(learned, action):
    metrics, told = imitate(learned, action, IN_VIEW)
    assert metrics["triggered_by_state"] == 0
    assert metrics["order_correct"]
    assert len(told.times_of("trigger")) == 1  # its own hand, back at rest, is none


def test_a_trigger_hand_that_stays_does_not_restart_the_action(learned, action):
    _, told = imitate(learned, action, "replay.after=6")
    assert len(told.times_of("trigger")) == 1
    assert len(told.times_of("ended")) == 1


@pytest.mark.parametrize("state", [1, 2])
def test_a_trigger_hand_that_stays_does_not_divert_the_arm(learned, action, state):
    x, y = action.states[state].place
    place = f"demonstrator.place=[{x},{y}]"
    stays, _ = imitate(learned, action, place)
    leaves, _ = imitate(learned, action, place, "demonstrator.stay=1.0")
    assert stays["order_correct"]
    assert leaves["order_correct"]


def test_a_hand_that_comes_again_starts_the_action_again(learned, action):
    x, y = action.states[2].place
    shown = f"[[1,{x},{y}],[2,{x},{y}],[2.1,{x},300],[9,{x},300],[9.1,{x},{y}],[11,{x},{y}]]"
    words = ["demonstrator=waypoints", f"demonstrator.waypoints={shown}", "replay.after=6"]
    _, told = imitate(learned, action, *words)
    assert len(told.times_of("trigger")) == 2


def test_while_the_action_plays_another_hand_triggers_nothing(learned, action):
    (ax, ay), (bx, by) = action.states[0].place, action.states[1].place
    shown = f"[[1,{ax},{ay}],[3,{ax},{ay}],[3.5,{bx},{by}],[6,{bx},{by}],[6.5,{bx},300]]"
    words = ["demonstrator=waypoints", f"demonstrator.waypoints={shown}"]
    metrics, told = imitate(learned, action, *words)
    assert len(told.times_of("trigger")) == 1
    assert metrics["triggered_by_state"] == 0


def test_an_action_seen_with_another_field_is_replayed(learned):
    coarse = demonstrated(0, IDEAL, "field=right_3x3")
    metrics, _ = imitate(learned, coarse)
    assert metrics["order_correct"]


def test_the_same_seed_replays_the_same(learned, action):
    one, other = (imitate(learned, action, seed=3)[0] for _ in range(2))
    assert one == other


def test_an_interrupted_replay_stops_the_arm_and_says_where(learned, action):
    words = ["map=given", "action=given", IDEAL, "~object"]
    _, samples = replaying(Bench({**composed("replay", *words), "seed": 0}), learned, action)
    for sample in samples:
        if np.any(sample.applied.sent != 0) and sample.seen.time > 3.8:
            break
    last = [samples.throw(KeyboardInterrupt())]
    with pytest.raises(KeyboardInterrupt):
        last += samples
    assert [event.kind for event in last[0].events] == ["stopped"]
    assert "state 2 of 4" in last[0].events[0].sentence
    assert not last[-1].applied.sent.any()


def test_a_replay_of_which_nobody_knows_the_truth_is_judged_by_the_map(learned, action):
    bench = Bench(composed("replay", "map=given", "action=given", IDEAL, "~object"))
    metrics = deferred_metrics(bench, learned, action)
    for sample in replaying(bench, learned, action)[1]:
        metrics.add(sample, [])
    told = metrics.result()
    assert told["own_from"] == "map read at the posture"
    assert told["order_correct"]
    assert told["grasped"] is None
    assert told["object_error_m"] is None


def test_the_object_ends_where_it_is_after_the_last_step(learned, action):
    bench = Bench(composed("replay", "map=given", "action=given", IDEAL, "~object"))
    metrics = deferred_metrics(bench, learned, action)
    for sample in replaying(bench, learned, action)[1]:
        after = sample.applied.time_ns + 40_000_000
        metrics.add(sample, [Truth(after, np.zeros(2), np.zeros(3), np.full(7, after / 1e9))])
    assert metrics.result()["object_end_m"][0] == after / 1e9


def test_a_replay_that_takes_too_long_stops_the_arm_and_says_where(learned, action):
    words = ["map=given", "action=given", IDEAL, "~object", "replay.limit=4"]
    recall, samples = replaying(Bench({**composed("replay", *words), "seed": 0}), learned, action)
    *_, last = steps = list(samples)
    assert [event.kind for step in steps for event in step.events][-1] == "stopped"
    assert recall.where == "in state 2 of 4, area [2, 2]"
    assert not last.applied.sent.any()


@pytest.fixture(scope="module")
def katana():
    """A map of the simulated Katana."""
    return lesson().learner.learned


def test_the_can_is_grasped_carried_and_put_where_the_demonstrator_put_it(katana, action):
    metrics = replayed(0, katana, action, "object.scatter=0.01").result()
    assert metrics["order_correct"]
    assert metrics["grasped"]
    assert metrics["object_error_m"] < 0.04


@pytest.mark.slow
def test_a_can_that_a_hand_has_begun_to_carry_is_taken_over_and_put_where_it_belongs(
    katana, action
):
    (x, y), (bx, by) = action.states[1].place, action.states[2].place
    words = f"demonstrator.place=[{x},{y}]", f"object.seen_px=[{bx},{by}]"
    metrics = replayed(0, katana, action, *words).result()
    assert metrics["triggered_by_state"] == 1
    assert metrics["order_correct"]
    assert metrics["grasped"]
    assert metrics["object_error_m"] < 0.04


def test_a_gripper_without_force_does_not_carry_the_can(katana, action):
    metrics = replayed(0, katana, action, "robot.arm.gripper.force=0").result()
    assert metrics["order_correct"]
    assert not metrics["grasped"]


@pytest.mark.slow
def test_without_a_can_the_arm_does_the_same_with_an_empty_hand(katana, action):
    metrics = replayed(0, katana, action, "~object").result()
    assert metrics["order_correct"]
    assert not metrics["grasped"]
    assert metrics["object_error_m"] is None
