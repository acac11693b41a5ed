"""Where points of an arm's links are, against hand-made arms and the engine."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from imitation.robots.bullet.world import Mark, World, find_urdf
from imitation.robots.bullet.world_table import Table
from imitation.robots.kinematic_chain import (
    KinematicChain,
    read_joints,
    rotation_about,
    rotation_of_rpy,
)

TWO_LINKS = """<robot name="two_links">
  <link name="base"/> <link name="upper"/> <link name="fore"/> <link name="hand"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.5"/><axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="3"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/>
    <origin xyz="0.3 0 0"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="4"/></joint>
  <joint name="wrist" type="fixed"><parent link="fore"/><child link="hand"/>
    <origin xyz="0.2 0 0" rpy="0 0 1.5707963267948966"/></joint>
</robot>"""

KATANA = tuple(
    f"katana_motor{joint}_joint"
    for joint in ("1_pan", "2_lift", "3_lift", "4_lift", "5_wrist_roll")
)
AT = (0.03, 0.0, 0.045)  # of the mark in the gripper's link [m]

angles = st.floats(-np.pi, np.pi)


@pytest.fixture
def urdf(tmp_path):
    path = tmp_path / "two_links.urdf"
    path.write_text(TWO_LINKS)
    return path


@pytest.fixture
def chain(urdf):
    points = [("hand", np.zeros(3)), ("upper", np.array([0.1, 0.0, 0.0])), ("base", np.zeros(3))]
    return KinematicChain(urdf, ("shoulder", "elbow"), points, base=np.array([1.0, 0.0, 0.0]))


def test_a_stretched_arm_reaches_its_length(chain):
    hand, upper, base = chain.positions(np.zeros(2))
    assert hand == pytest.approx([1.5, 0.0, 0.5])
    assert upper == pytest.approx([1.1, 0.0, 0.5])
    assert base == pytest.approx([1.0, 0.0, 0.0])


def test_a_bent_elbow_turns_the_forearm_alone(chain):
    hand, upper, _ = chain.positions(np.array([0.0, np.pi / 2]))
    assert hand == pytest.approx([1.3, 0.2, 0.5])
    assert upper == pytest.approx([1.1, 0.0, 0.5])


def test_a_point_in_the_hand_is_turned_by_the_fixed_joint(urdf):
    chain = KinematicChain(urdf, ("elbow",), [("hand", np.array([0.1, 0, 0]))], np.zeros(3))
    assert chain.positions(np.zeros(1))[0] == pytest.approx([0.5, 0.1, 0.5])


def test_many_postures_at_once_are_the_same_as_one_by_one(chain):
    postures = np.random.default_rng(0).uniform(-1, 1, (7, 2))
    expected = [chain.positions(posture) for posture in postures]
    np.testing.assert_allclose(chain.positions(postures), expected, atol=1e-15)


def test_joint_limits_come_from_the_file_in_the_order_asked_for(urdf):
    chain = KinematicChain(urdf, ("elbow", "shoulder"), [("hand", np.zeros(3))], np.zeros(3))
    assert [(joint.lower, joint.upper, joint.speed) for joint in chain.limits] == [
        (-2, 2, 4),
        (-1, 2, 3),
    ]


def test_an_unknown_joint_is_refused_with_those_there_are(urdf):
    with pytest.raises(ValueError, match=r"no joint knee; it has .*elbow.*shoulder"):
        KinematicChain(urdf, ("shoulder", "knee"), [], np.zeros(3))


def test_a_joint_without_a_child_is_refused_by_name(tmp_path):
    path = tmp_path / "broken.urdf"
    path.write_text('<robot><joint name="loose" type="fixed"><parent link="base"/></joint></robot>')
    with pytest.raises(ValueError, match="joint loose lacks parent or child"):
        read_joints(path)


@given(st.tuples(angles, angles, angles).filter(lambda axis: np.linalg.norm(axis) > 0.1), angles)
def test_a_rotation_leaves_its_axis_and_turns_back(axis, angle):
    axis = np.array(axis) / np.linalg.norm(axis)
    turn = rotation_about(axis, angle)
    np.testing.assert_allclose(turn @ axis, axis, atol=1e-12)
    np.testing.assert_allclose(turn @ rotation_about(axis, -angle), np.eye(3), atol=1e-12)


def test_roll_pitch_and_yaw_turn_about_fixed_axes_in_this_order():
    turned = rotation_of_rpy(np.pi / 2, 0.0, np.pi / 2) @ np.array([0.0, 1.0, 0.0])
    assert turned == pytest.approx([0, 0, 1])  # roll lifts y to z, where yaw leaves it


@pytest.fixture(scope="module")
def world():
    world = World(
        urdf="katana_6m180.urdf",
        joints=KATANA,
        fingers=None,
        mark=Mark("katana_gripper_link", AT, 0.012, (1.0, 0.0, 0.0, 1.0)),
        table=Table((1.0, 0.9, 0.04), (0.3, 0.0, -0.02), (0.6, 0.6, 0.55, 1.0), 0.8),
        base=(0.1, -0.2, 0.0),
        rate=250,
        iterations=50,
        force=(60.0, 60.0, 60.0, 40.0, 20.0),
    )
    yield world
    world.close()


@pytest.mark.parametrize("seed", range(5))
def test_the_katanas_hand_is_where_the_engine_puts_it(world, seed):
    points = [("katana_gripper_link", np.array(AT))]
    chain = KinematicChain(find_urdf("katana_6m180.urdf"), KATANA, points, np.array(world.base))
    lower, upper = np.array([(joint.lower, joint.upper) for joint in chain.limits]).T
    posture = np.random.default_rng(seed).uniform(lower, upper)
    world.rebuild(posture, opening=1.0)
    assert chain.positions(posture)[0] == pytest.approx(world.mark_position(), abs=1e-5)
