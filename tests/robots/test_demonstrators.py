"""Another's hand before the simulated camera."""

import numpy as np
import pytest
from on_bench import bench

from cli.build import Bench
from imitation.robot import Command

BODIES = ["ideal", "katana_sim", "kuka_sim", "so101_sim"]


def aside(body: str, *words: str):
    """Parts whose camera is told to look away from the arm."""
    cfg = bench("learn-map", f"robot={body}", "camera.noise_px=0", *words).cfg
    return Bench({**cfg, "shift": cfg["robot"]["head"]["aside"]})


def looking_aside(parts, steps: int):
    """What is sensed step by step with the neck turned to the reference gaze."""
    robot = parts.robot
    robot.reset()
    turned = Command(np.zeros(len(robot.home)), gaze=np.array(parts.space.reference))
    return [robot.step(turned)[0] for _ in range(steps)]


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("hand", ["tag", "skin"])
def test_the_hand_is_seen_within_half_a_pixel_of_where_it_truly_is(body, hand):
    words = ("demonstrator=circle", "demonstrator.period=4", f"demonstrator.hand={hand}")
    vision = {"tag": "red_tag", "skin": "skin"}[hand]
    parts = aside(body, f"vision={vision}", *words)
    perception = parts.perception(parts.field)
    for step, seen in enumerate(looking_aside(parts, 120), start=1):
        truth = parts.demonstrator.place(0.04 * step)
        assert np.linalg.norm(perception.perceive(seen).hand - truth) < 0.5
    parts.robot.close()


@pytest.mark.parametrize("body", ["ideal", "katana_sim"])
@pytest.mark.parametrize(("hand", "vision"), [("tag", "skin"), ("skin", "red_tag")])
def test_a_hand_of_another_colour_is_not_seen(body, hand, vision):
    words = ("demonstrator=circle", f"demonstrator.hand={hand}", f"vision={vision}")
    parts = aside(body, *words)
    perception = parts.perception(parts.field)
    assert all(perception.perceive(seen).hand is None for seen in looking_aside(parts, 5))
    parts.robot.close()


@pytest.mark.parametrize("body", BODIES)
def test_aside_no_posture_of_the_hull_is_in_view_and_the_table_fills_it(body):
    parts, rng = aside(body), np.random.default_rng(4)
    hull = [*parts.guided, *(rng.dirichlet(np.full(4, 0.3), 20) @ parts.guided)]
    robot, gaze = parts.robot, np.array(parts.space.reference)
    for posture in hull:
        robot.reset(posture)
        seen, _ = robot.step(Command(np.zeros(len(robot.home)), gaze=gaze))
        assert len(np.unique(seen.frame.reshape(-1, 3), axis=0)) == 1
        assert seen.frame.max() < 255
    robot.close()


def test_aside_the_robots_own_hand_is_still_located_as_in_learning():
    parts = bench("learn-map", "robot=ideal"), aside("ideal")
    for one in parts:
        one.robot.reset()
        one.robot.step(Command(np.zeros(5), gaze=np.array(one.space.reference)))
    straight, turned = (one.robot.truth()[-1] for one in parts)
    assert turned.hand_px.tolist() == straight.hand_px.tolist()


def test_the_true_gaze_is_told():
    parts = aside("ideal")
    before, after = parts.robot.reset(), looking_aside(parts, 1)[0]
    assert before.gaze.tolist() == list(parts.learning_space.reference)
    assert after.gaze.tolist() == list(parts.space.reference) == [-0.14 + 0.65, -1.09]


@pytest.mark.parametrize("body", ["ideal", "katana_sim"])
def test_a_hand_that_is_gone_is_not_drawn(body):
    words = ("demonstrator=trigger", "demonstrator.at=0.2", "demonstrator.stay=0.2")
    parts = aside(body, *words)
    perception = parts.perception(parts.field)
    found = [perception.perceive(seen).hand is not None for seen in looking_aside(parts, 15)]
    assert found == [0.2 <= round(0.04 * step, 2) <= 0.4 for step in range(1, 16)]
    parts.robot.close()


def test_a_demonstration_begins_anew_with_each_episode():
    parts = aside("ideal", "demonstrator=circle", "demonstrator.start=0")
    one, other = ([seen.frame for seen in looking_aside(parts, 10)] for _ in range(2))
    assert np.array_equal(one, other)


@pytest.mark.parametrize("body", ["ideal", "katana_sim"])
def test_own_and_other_hand_may_both_be_seen(body):
    parts = bench("learn-map", f"robot={body}", "demonstrator=trigger", "demonstrator.at=0.04")
    robot, perception = parts.robot, parts.perception(parts.field)
    alone = len(perception.detector.hand_pixels(robot.reset().frame))
    seen, _ = robot.step(Command(np.zeros(5)))
    assert len(perception.detector.hand_pixels(seen.frame)) > 1.5 * alone
    robot.close()


def test_a_raised_hand_is_seen_where_its_height_brings_it():
    level, raised = (
        bench("learn-map", "demonstrator=trigger", f"demonstrator.raise={higher}").demonstrator
        for higher in (0.0, 0.05)
    )
    low, high = level.at(2.0).mark, raised.at(2.0).mark
    assert high - low == pytest.approx([0, 0, 0.05])
    assert level.place(2.0) == pytest.approx([20, 75])
    assert np.linalg.norm(raised.place(2.0) - level.place(2.0)) > 10


def test_a_hand_of_no_known_kind_is_refused():
    with pytest.raises(ValueError, match=r"demonstrator.hand=glove .* tag, skin"):
        bench("learn-map", "demonstrator=circle", "demonstrator.hand=glove").demonstrator  # noqa: B018


def test_nobody_demonstrates_unless_asked_to():
    assert bench("learn-map").demonstrator is None
