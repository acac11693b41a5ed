"""A can that only contact and friction hold, and a demonstrator who carries one."""

from dataclasses import replace

import numpy as np
import pytest
from on_bench import bench

from imitation.dynamics import able_to_stop
from imitation.robot import Command
from imitation.robots.bullet.world import find_urdf
from imitation.robots.kinematic_chain import KinematicChain

BETWEEN_PADS = ("katana_gripper_link", np.array([0.10, 0.0, 0.0]))
MIDDLE, RIGHT = (0.5, 0.3), (0.62, 0.3)  # shares of right and of far between the guided postures


def hull_posture(right: float, far: float):
    """A posture between the guided ones, near left, near right, far left, far right [rad]."""
    near_left, near_right, far_left, far_right = np.array(bench("learn-map").guided)
    near, away = (
        (1 - right) * left + right * other
        for left, other in ((near_left, near_right), (far_left, far_right))
    )
    return (1 - far) * near + far * away


def seen_at(posture) -> list[float]:
    """Where the hand's mark is seen at `posture`, (2,) [px]."""
    robot = bench("learn-map", "robot=ideal").robot
    robot.reset(posture)
    return robot.truth()[-1].hand_px.tolist()


def between_pads(posture):
    """Where what the hand holds is, (3,) [m]."""
    arm = bench("learn-map").cfg["robot"]["arm"]
    chain = KinematicChain(
        find_urdf(arm["urdf"]), tuple(arm["joints"]), [BETWEEN_PADS], np.zeros(3)
    )
    return chain.positions(posture)[0]


def with_can(posture, *words: str, seed: int = 0):
    """Parts with a can where the hand would hold it at `posture`."""
    place = f"object.seen_px={seen_at(posture)}"
    return bench("learn-map", "+object=can", place, *words, seed=seed)


class Hand:
    """Moves an arm to postures, as replay does."""

    def __init__(self, parts) -> None:
        self.robot, self.seen = parts.robot, parts.robot.reset(parts.rest)

    def go(self, goal, grip: float, until=lambda seen: False, limit: float = 6.0) -> None:
        """Come to rest at `goal` [rad], or stop on the way as soon as told."""
        end = self.seen.time + limit
        while np.abs(goal - self.seen.posture).max() > 0.02 and self.seen.time < end:
            self.step(goal, grip)
            if until(self.seen):
                return

    def stay(self, grip: float, seconds: float) -> None:
        """Hold the posture."""
        here = self.seen.posture
        for _ in range(round(seconds / self.robot.period)):
            self.step(here, grip)

    def step(self, goal, grip: float) -> None:
        body, to_go = self.robot.body, goal - self.seen.posture
        velocity = able_to_stop(to_go / 0.1, to_go, 0.9 * body.acceleration, self.robot.period)
        self.seen, _ = self.robot.step(Command(velocity, grip))

    @property
    def can(self):
        """Pose of the can, (7,)."""
        return self.robot.truth()[-1].object_pose


def tilt(pose) -> float:
    """How far a can leans [rad]."""
    x, y = pose[3:5]
    return float(2 * np.arcsin(min(np.hypot(x, y), 1.0)))


def moved_by_hand(parts, start, goal):
    """Whether the can was held to the end of the way, and its pose after it was let go."""
    grasp, hand = parts.cfg["robot"]["grasp"], Hand(parts)
    hand.go(start + grasp["drawn_back"], 1.0)
    hand.go(start, 1.0, until=lambda seen: seen.proximity < grasp["close_within"])
    hand.stay(0.0, 1.2)
    for posture in (start, goal):
        hand.go(posture + grasp["lifted"], 0.0)
    held = hand.seen.touching
    hand.go(goal + grasp["lowered"], 0.0)
    hand.stay(1.0, grasp["opening"])
    hand.go(goal + grasp["leaving"], 1.0)
    return held, hand.can


def test_a_can_stands_where_the_hand_would_hold_it():
    for right, far in ((0.2, 0.1), (0.5, 0.3), (0.8, 0.6)):
        posture = hull_posture(right, far)
        parts = with_can(posture)
        assert parts.thing.centre[:2] == pytest.approx(between_pads(posture)[:2], abs=0.012)
        assert parts.thing.centre[2] == pytest.approx(0.04)


def test_a_can_may_stand_beside_that_place_by_a_given_or_a_random_distance():
    posture = hull_posture(*MIDDLE)
    there, off = with_can(posture).thing, with_can(posture, "object.off_m=[0.02,-0.01]").thing
    assert np.subtract(off.centre, there.centre) == pytest.approx([0.02, -0.01, 0])
    drawn = [with_can(posture, "object.scatter=0.01", seed=seed).thing for seed in range(20)]
    apart = np.linalg.norm(np.subtract([one.centre for one in drawn], there.centre), axis=1)
    assert 0.003 < apart.mean() < apart.max() <= 0.01


def test_a_can_that_nothing_touches_stands_still_and_is_not_felt():
    parts = with_can(hull_posture(*MIDDLE))
    hand = Hand(parts)
    before = hand.can
    hand.stay(1.0, 2.0)
    assert hand.can == pytest.approx(before, abs=1e-3)
    assert (hand.seen.proximity, hand.seen.touching) == (np.inf, False)


@pytest.mark.parametrize("vision", ["red_tag", "skin"])
def test_a_can_is_taken_for_no_hand(vision):
    parts = with_can(hull_posture(*MIDDLE), f"vision={vision}")
    seen = parts.robot.reset(parts.rest)
    assert len(np.unique(seen.frame.reshape(-1, 3), axis=0)) > 1  # it is in view
    assert parts.perception(parts.field).perceive(seen).hand is None


def test_a_can_between_the_open_fingers_is_felt_and_between_closed_ones_is_touched():
    posture = hull_posture(*MIDDLE)
    hand = Hand(with_can(posture))
    hand.seen = hand.robot.reset(posture)
    assert 0.01 < hand.seen.proximity < 0.03
    assert not hand.seen.touching
    hand.stay(0.0, 1.2)
    assert hand.seen.touching
    assert 0.2 < hand.seen.opening < 0.7


def test_a_closed_hand_lifts_the_can_by_friction_and_an_open_one_lets_it_fall():
    posture = hull_posture(*MIDDLE)
    hand = Hand(with_can(posture))
    hand.seen = hand.robot.reset(posture)
    hand.stay(0.0, 1.2)
    hand.go(posture + np.array([0, 0.3, 0, 0, 0]), 0.0)
    assert hand.can[2] > 0.09
    hand.stay(1.0, 1.0)
    assert hand.can[2] < 0.05


@pytest.mark.parametrize("grip", [0.0, 0.5, 0.9])
def test_an_arm_that_presses_on_a_can_forces_no_finger_beyond_its_stops(grip):
    posture = hull_posture(*MIDDLE)
    hand = Hand(with_can(posture, "object.radius=0.06", "object.height=0.06"))
    hand.seen = hand.robot.reset(posture + np.array([0, 0.35, 0, 0, 0]))
    hand.stay(grip, 1.0)
    openings = []
    for _ in range(40):
        hand.step(posture - np.array([0, 0.15, 0, 0, 0]), grip)
        openings.append(hand.seen.opening)
    assert 0 <= min(openings) <= max(openings) <= 1
    assert np.ptp(openings) > 0.05  # it did press


def test_the_tag_is_seen_where_it_is_while_the_hand_holds_a_can():
    start, goal = hull_posture(*MIDDLE), hull_posture(*RIGHT)
    parts = with_can(start, "camera.noise_px=0")
    hand, perception = Hand(parts), parts.perception(parts.field)
    hand.seen = parts.robot.reset(start)
    hand.stay(0.0, 1.2)
    for posture in (start, goal):
        hand.go(posture, 0.0)
        place = perception.perceive(hand.seen).hand
        assert place == pytest.approx(parts.robot.truth()[-1].hand_px, abs=0.3)


def test_the_hand_takes_a_can_carries_it_and_puts_it_down_upright():
    start, goal = hull_posture(*MIDDLE), hull_posture(*RIGHT)
    held, after = moved_by_hand(with_can(start), start, goal)
    assert held
    assert tilt(after) < 0.05
    assert after[:2] == pytest.approx(between_pads(goal)[:2], abs=0.04)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_a_can_a_cm_off_its_place_is_put_down_within_4_cm_wherever_it_stands(seed):
    places = np.random.default_rng(seed).uniform((0.2, 0.1), (0.6, 0.7), (2, 2))
    start, goal = (hull_posture(*place) for place in places)
    held, after = moved_by_hand(with_can(start, "object.scatter=0.01", seed=seed), start, goal)
    assert held
    assert tilt(after) < 0.05
    assert np.linalg.norm(after[:2] - between_pads(goal)[:2]) < 0.04


def watched(parts, seconds: float):
    """Poses of the can and times while the arm rests."""
    hand, poses = Hand(parts), []
    while hand.seen.time < seconds:
        hand.step(hand.seen.posture, 1.0)
        poses.append((hand.seen.time, hand.can))
    return poses


def test_a_demonstrator_carries_the_can_below_the_hand_and_leaves_it_standing():
    parts = bench("learn-map", "+object=can", "demonstrator=pick_and_place")
    poses, demonstrator = watched(parts, 13.0), parts.demonstrator
    start = np.array(parts.thing.centre)
    for time, pose in poses:
        shown = demonstrator.at(time)
        if shown.carrying:
            outwards = parts.cfg["robot"]["holding"]["outwards"]
            assert np.linalg.norm(shown.mark[:2] - pose[:2]) == pytest.approx(outwards, abs=0.001)
        assert tilt(pose) < 0.01
        assert pose[2] == pytest.approx(0.04, abs=0.001)
    assert poses[0][1][:3] == pytest.approx(start, abs=1e-4)
    assert np.linalg.norm(poses[-1][1][:2] - start[:2]) > 0.08


def test_pick_and_place_takes_the_can_where_it_stands():
    parts = bench("learn-map", "+object=can", "demonstrator=pick_and_place")
    assert parts.cfg["demonstrator"]["places"][1] == parts.cfg["object"]["seen_px"]


def test_each_episode_has_its_can_back_and_goes_the_same_way():
    start, goal = hull_posture(*MIDDLE), hull_posture(*RIGHT)
    parts = with_can(start)
    first, second = (moved_by_hand(parts, start, goal)[1] for _ in range(2))
    assert first.tobytes() == second.tobytes()


def test_an_arm_without_an_engine_has_no_object():
    assert bench("learn-map", "+object=can", "robot=ideal").thing is None


@pytest.mark.parametrize("body", ["katana_sim", "kuka_sim", "so101_sim"])
def test_at_rest_no_part_of_the_arm_is_in_view(body):
    parts = bench("learn-map", f"robot={body}")
    frame = parts.robot.reset(parts.rest).frame
    assert len(np.unique(frame.reshape(-1, 3), axis=0)) == 1


@pytest.mark.parametrize("body", ["katana_sim", "kuka_sim", "so101_sim"])
def test_from_rest_the_arm_comes_to_every_place_well_above_the_table(body):
    parts = bench("learn-map", f"robot={body}")
    grasp, rng = parts.cfg["robot"]["grasp"], np.random.default_rng(0)
    back = grasp["drawn_back"] if grasp else np.zeros(len(parts.rest))
    hull = rng.dirichlet(np.full(4, 0.5), 60) @ parts.guided + back
    ways = np.concatenate([np.linspace(parts.rest, goal, 15) for goal in hull])
    around = parts.robot.guard.surroundings
    alone = replace(around, apart=np.zeros_like(around.apart))  # nearer to its own shoulder
    assert alone.clearance(ways).min() > 0.03
    assert around.clearance(ways).min() > parts.robot.guard.least_clearance
