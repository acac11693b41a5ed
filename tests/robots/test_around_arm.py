"""Where the guard lets an arm be, it touches neither the table nor itself nor its camera."""

from collections.abc import Iterator

import numpy as np
import pytest
from on_bench import bench

from imitation.arrays import Array
from imitation.robots.around_arm import AroundArm
from imitation.robots.bullet.arm import BulletArm
from imitation.robots.bullet.world import World, pybullet
from imitation.robots.kinematic_chain import KinematicChain

# A hand at the end of two links of 0.3 m and 0.2 m that turn about the vertical, 0.5 m high.
TWO_LINKS = """<robot name="two_links">
  <link name="base"/> <link name="upper"/> <link name="hand"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.5"/><axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="3"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="hand"/>
    <origin xyz="0.3 0 0"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="4"/></joint>
</robot>"""
HAND, SHOULDER = ("hand", np.array([0.2, 0.0, 0.0])), ("base", np.array([0.0, 0.0, 0.5]))
FAR = np.array([0.0, 0.0, 5.0])
TOUCHING = 0.0  # how near the engine looks for what touches [m]
# Shapes of the engine's own file that overlap wherever the joint between them is.
ALWAYS = {("lbr_iiwa_link_5", "lbr_iiwa_link_7")}


@pytest.fixture
def around(tmp_path):
    """Makes what stands around the two links: table, base, head, and their own shoulder."""
    path = tmp_path / "two_links.urdf"
    path.write_text(TWO_LINKS)
    chain = KinematicChain(path, ("shoulder", "elbow"), [HAND, SHOULDER], np.zeros(3))

    def made(base_radius=0.0, base_height=0.0, head=FAR, shoulder=0.0, apart=True) -> AroundArm:
        return AroundArm(
            chain=chain,
            radii=np.array([0.05]),
            trunk_radii=np.array([shoulder]),
            apart=np.array([[apart]]),
            table_height=0.1,
            base=np.zeros(2),
            base_radius=base_radius,
            base_height=base_height,
            head=head,
            head_radius=0.1,
        )

    return made


STRETCHED, FOLDED = np.array([[0.0, 0.0]]), np.array([[0.0, np.pi]])


def test_a_stretched_arm_is_as_near_to_the_table_as_its_hand_is_above_it(around):
    assert around().clearance(STRETCHED) == pytest.approx([0.5 - 0.05 - 0.1])


def test_it_is_as_near_to_the_base_as_its_hand_is_beside_it(around):
    tall = around(base_radius=0.2, base_height=0.6)
    assert tall.clearance(STRETCHED) == pytest.approx([0.5 - 0.2 - 0.05])
    assert tall.clearance(FOLDED) == pytest.approx([-0.15])  # 0.1 m from the axis, 0.1 m too low


def test_it_is_as_near_to_its_own_shoulder_as_its_hand_is(around):
    broad = around(shoulder=0.07)
    assert broad.clearance(FOLDED) == pytest.approx([0.1 - 0.05 - 0.07])
    joined = around(shoulder=0.07, apart=False)
    assert joined.clearance(FOLDED) == pytest.approx(around().clearance(STRETCHED))


def test_it_is_as_near_to_the_camera_as_its_hand_is_below_it(around):
    low = around(head=np.array([0.5, 0.0, 0.7]))
    assert low.clearance(STRETCHED) == pytest.approx([0.2 - 0.1 - 0.05])


BODIES = ("katana_sim", "kuka_sim", "so101_sim")


@pytest.mark.parametrize("body", BODIES)
def test_wherever_the_guard_lets_an_arm_be_it_touches_neither_table_nor_itself(body):
    assert touched(body, 150) == {}


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("body", BODIES)
def test_it_touches_nothing_at_10000_places(body):
    assert touched(body, 10_000) == {}


def touched(body: str, count: int) -> dict[tuple[str, str], Array]:
    """A posture for each pair of shapes that touch in one of `count` that the guard lets be."""
    parts = bench("learn-map", f"robot={body}")
    arm = parts.robot.arm
    assert isinstance(arm, BulletArm)
    guard = parts.guard(arm.body)
    assert guard.surroundings is not None
    arm.reset(parts.guided.mean(axis=0))
    lower, upper = guard.lower + guard.margin, guard.upper - guard.margin
    rng, found = np.random.default_rng(3), {}
    while count:
        posture = rng.uniform(lower, upper)
        if guard.surroundings.clearance(posture[None])[0] < guard.least_clearance:
            continue
        count -= 1
        for pair in pairs_that_touch(arm.world, posture, opening=float(rng.integers(2))):
            found[pair] = posture
    arm.close()
    return found


def pairs_that_touch(world: World, posture: Array, opening: float) -> Iterator[tuple[str, str]]:
    """Names of the shapes that touch, the table's is `table`; links that a joint joins may."""
    client, arm = world._client, world._arm
    for joint, angle in zip(world._joints, posture, strict=True):
        pybullet.resetJointState(arm, joint, angle, physicsClientId=client)
    if world._gripper:
        world._gripper.place(opening)
    names = {-1: "base", **{number: name for name, number in world._links.items()}}
    for row in pybullet.getClosestPoints(arm, 0, TOUCHING, physicsClientId=client):
        if row[3] >= 0:  # the base stands on the table
            yield names[row[3]], "table"
    parents = {link: pybullet.getJointInfo(arm, link, client)[16] for link in names if link >= 0}
    for one in names:
        for other in [link for link in names if link > one and parents[link] != one]:
            close = pybullet.getClosestPoints(
                arm, arm, TOUCHING, one, other, physicsClientId=client
            )
            if close and (names[one], names[other]) not in ALWAYS:
                yield names[one], names[other]
