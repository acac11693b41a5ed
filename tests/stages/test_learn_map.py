"""Learning where the own hand is, by watching it."""

import numpy as np
import pytest
from on_bench import bench, lesson

from cli.stages import learning
from imitation.analysis.metrics import learn_map_metrics
from imitation.arrays import Array
from imitation.deciding import one_attractor
from imitation.hull import nearest_mixture
from imitation.robot import Robot
from imitation.robots.ideal import IdealArm
from imitation.stages.babbling import Babbling, Curiosity, Goal
from imitation.stages.learn_map import Learner, LearningRun, learn_map

BLIND = "vision.hue=[80,100]"  # the hand is red, not green


@pytest.fixture(scope="module")
def late_lesson():
    """16 areas learned from frames that come 5 steps late."""
    return lesson("robot=ideal", "camera.delay_frames=5")


@pytest.fixture(scope="module")
def half_lesson():
    """What is learned when the arm was guided on the table's left half only."""
    near, far = [0.42, 1.336, -2.112, 0.254, 0.0], [0.28, 0.285, -0.203, 0.972, 0.0]
    ahead = [[0.05, *posture[1:]] for posture in (near, far)]
    return lesson("robot=ideal", f"robot.guided={[near, far, *ahead]}", "learning.patience=3")


def metrics_of(learnt) -> dict:
    return learn_map_metrics(learnt.learner.learned, learnt.learner.shown)


def inside(learnt) -> list[bool]:
    """Whether each posture, revisited, showed the hand inside its area."""
    field = learnt.learner.learned.field
    return [field.area_of(place) == area for area, place in learnt.learner.shown.items()]


def test_all_16_areas_are_learned_and_each_posture_revisited_shows_the_hand_inside(ideal_lesson):
    assert len(ideal_lesson.learner.shown) == 16
    assert all(inside(ideal_lesson))
    assert metrics_of(ideal_lesson)["coverage"] == 1.0
    assert metrics_of(ideal_lesson)["place_error_px"] <= 8
    assert ideal_lesson.times[-1] < 60


def test_9_areas_are_learned_likewise():
    learnt = lesson("robot=ideal", "field=right_3x3")
    assert len(learnt.learner.shown) == 9
    assert all(inside(learnt))


@pytest.mark.parametrize(
    "body", ["katana_sim", "kuka_sim", pytest.param("so101_sim", marks=pytest.mark.slow)]
)
def test_arms_in_the_engine_learn_all_areas_too(body):
    learnt = lesson(f"robot={body}")
    assert len(learnt.learner.shown) == 16
    assert all(inside(learnt))
    assert max(learnt.off) < 2.0
    learnt.bench.robot.close()


def test_every_area_is_told_once_when_it_is_learned(ideal_lesson):
    told = [event.facts["area"] for event in ideal_lesson.events if event.kind == "learned"]
    field = ideal_lesson.learner.learned.field
    assert sorted(told) == np.argwhere(field.reachable).tolist()


def test_every_learned_posture_truly_shows_the_hand_where_the_map_says(ideal_lesson):
    assert max(ideal_lesson.off) < 2.0


def test_a_late_frame_is_paired_with_the_posture_it_was_taken_at(late_lesson):
    assert len(late_lesson.learner.shown) == 16
    assert all(inside(late_lesson))
    assert max(late_lesson.off) < 2.0


def test_unpaired_late_frames_would_teach_places_that_are_wrong():
    learnt = lesson("robot=ideal", "camera.delay_frames=5", "learning.pairing=0.001")
    assert np.median(learnt.off) > 5.0


def test_the_same_seed_learns_the_same_and_another_one_something_else(ideal_lesson):
    again, other = (lesson("robot=ideal", seed=seed) for seed in (0, 1))
    assert np.array_equal(again.postures, ideal_lesson.postures)
    assert not np.array_equal(other.postures[:50], ideal_lesson.postures[:50])


def test_babbling_stays_in_the_hull_of_the_guided_postures(ideal_lesson):
    guided = ideal_lesson.bench.guided
    for posture in ideal_lesson.postures[::5]:
        assert nearest_mixture(guided, posture) == pytest.approx(posture, abs=0.001)


def test_learning_stops_at_the_limit():
    learnt = lesson("robot=ideal", "learning.limit=2")
    assert learnt.times[-1] + learnt.bench.robot.period == pytest.approx(2.0)
    assert 0 < learnt.learner.learned.learned.sum() < 16


def test_revisiting_stops_at_the_limit_too(ideal_lesson):
    limit = ideal_lesson.times[-1] - 0.5
    learnt = lesson("robot=ideal", f"learning.limit={limit}")
    assert learnt.times[-1] < limit
    assert learnt.learner.learned.learned.sum() == 16
    assert 0 < len(learnt.learner.shown) < 16


def test_babbling_ends_when_no_area_was_new_for_as_long_as_patience_lasts():
    learnt = lesson("robot=ideal", BLIND, "learning.patience=2")
    assert 2.0 <= learnt.times[-1] < 4.0  # the movement under way is ended
    assert not learnt.learner.learned.learned.any()
    assert learnt.learner.places == []
    assert metrics_of(learnt)["place_error_px"] is None


def test_areas_never_seen_are_named(half_lesson):
    field, metrics = half_lesson.learner.learned.field, metrics_of(half_lesson)
    never = metrics["areas_never_seen"]
    assert 0 < len(never) < 16
    assert all(half_lesson.learner.learned.visits[tuple(area)] == 0 for area in never)
    assert all(field.reachable[tuple(area)] for area in never)
    assert [0, 1] not in never  # far left
    assert [3, 4] in never  # near right
    assert metrics["areas_learned"] <= 16 - len(never)


def learner_of(parts, robot: Robot, limit: float = 120.0, learned=None) -> Learner:
    settings = LearningRun(**{**parts.cfg["learning"], "limit": limit})
    perception = parts.perception(parts.field)
    learner = Learner(robot, perception, parts.dynamics, learned or parts.empty_map(), settings)
    learner.begin()
    return learner


def goal_at(parts, posture) -> Goal:
    return Goal(one_attractor(np.asarray(posture)), np.zeros(parts.field.shape), None, None)


def test_a_movement_ends_within_arrival_of_its_goal():
    parts = bench("learn-map", "robot=ideal")
    learner, corner = learner_of(parts, parts.robot), parts.guided[0]
    steps = list(learner.move(goal_at(parts, corner), None))
    assert learner.seen.posture == pytest.approx(corner, abs=0.015)
    assert steps[-1].seen.time < 5.0


def test_a_revisit_names_the_neuron_it_goes_to_and_tells_where_the_hand_is_seen_at_last():
    parts = bench("learn-map", "robot=ideal", "learning.limit=2")
    learner, samples = learning(parts)
    list(samples)
    learned, seen = learner.learned, learner.seen
    area = sorted(map(tuple, np.argwhere(learned.learned).tolist()))[0]
    babbling = Babbling(parts.guided, Curiosity(**parts.cfg["curiosity"]), np.ones(5), None)
    goal = babbling.nearest_learned(learned, {area}, seen.posture)
    steps = list(learner_of(parts, parts.robot, learned=learned).move(goal, None))
    assert all(step.decision.index.tolist() == [[*area, 0]] for step in steps)
    (visited,) = steps[-1].events
    assert (visited.kind, visited.facts["area"]) == ("visited", list(area))
    assert visited.facts["place_px"] == pytest.approx(steps[-1].percept.hand, abs=0.005)


def test_a_goal_below_the_table_is_given_up():
    parts = bench("learn-map", "robot=ideal")
    learner = learner_of(parts, parts.robot)
    below = parts.guided[0] - np.array([0.0, 0.3, 0.0, 0.0, 0.0])
    steps = list(learner.move(goal_at(parts, below), None))
    assert not np.allclose(learner.seen.posture, below, atol=0.1)
    assert any("surroundings" in step.applied.reasons for step in steps)
    assert steps[-1].seen.time < 10.0


class JammedArm(IdealArm):
    """Something stands in the way of the arm's pan joint."""

    stop = 0.1  # [rad]

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        sent = super().move(velocity, grip, period)
        self._posture[0] = min(self._posture[0], self.stop)
        return sent


def jammed(parts) -> Robot:
    """The ideal robot of a bench with its arm jammed."""
    robot, arm = parts.robot, parts.robot.arm
    mark = arm.scene
    stuck = JammedArm(arm.body, arm._chain, mark.radius, mark.colour)
    robot.camera._scene, robot.arm = stuck.scene, stuck
    return robot


def test_a_jammed_arm_gives_its_goal_up():
    parts = bench("learn-map", "robot=ideal")
    learner = learner_of(parts, jammed(parts), limit=30.0)
    steps = list(learner.move(goal_at(parts, parts.guided[0]), None))
    assert learner.seen.posture[0] == JammedArm.stop
    assert learner.seen.posture[1:] == pytest.approx(parts.guided[0][1:], abs=0.02)
    assert steps[-1].applied.limited.any()  # it was told to go on to the last
    assert steps[-1].seen.time < 5.0


@pytest.mark.slow
def test_a_jammed_arm_learns_what_it_can_reach():
    parts = bench("learn-map", "robot=ideal")
    learner = learner_of(parts, jammed(parts), limit=40.0)
    rng, curiosity = np.random.default_rng(0), Curiosity(**parts.cfg["curiosity"])
    babbling = Babbling(parts.guided, curiosity, parts.robot.body.speed, rng)
    for _ in learn_map(learner, babbling):
        pass
    assert 4 <= learner.learned.learned.sum() < 16
