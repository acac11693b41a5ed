"""Builds arms and their cameras from plain values; `_target_` in the configuration names these."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from imitation.gaze import VisualSpace
from imitation.guard import Guard
from imitation.robot import Body
from imitation.robots.around_arm import AroundArm
from imitation.robots.bullet.arm import BulletArm
from imitation.robots.bullet.world import Mark, World, find_urdf
from imitation.robots.bullet.world_can import Can
from imitation.robots.bullet.world_gripper import Fingers
from imitation.robots.bullet.world_table import Table
from imitation.robots.demonstrators import Demonstrator
from imitation.robots.ideal import IdealArm, pixel
from imitation.robots.kinematic_chain import KinematicChain, read_joints
from imitation.robots.simulated_camera import Scene, SimulatedCamera

Numbers = Sequence[float]

ROUNDING = 1e-6  # what a period counted in whole nanoseconds may be off [physics steps]


def body_of(
    name: str,
    urdf: str,
    joints: Sequence[str],
    base: Numbers,
    speed: Numbers | None,
    acceleration: Numbers,
) -> Body:
    """Joints and limits of an arm: ranges from its URDF, and speeds unless given."""
    chain = KinematicChain(find_urdf(urdf), tuple(joints), [], np.asarray(base))
    from_urdf = [joint.speed for joint in chain.limits]
    body = Body(
        name=name,
        joint_names=tuple(joints),
        lower=np.array([joint.lower for joint in chain.limits]),
        upper=np.array([joint.upper for joint in chain.limits]),
        speed=np.array(from_urdf if speed is None else speed),
        acceleration=np.array(acceleration),
    )
    for key, values in (("speed", body.speed), ("acceleration", body.acceleration)):
        if len(values) != len(joints) or not np.all(values > 0):
            raise ValueError(f"robot.arm.{key} needs {len(joints)} numbers above 0, got {values}")
    return body


def bullet_arm(
    name: str,
    urdf: str,
    joints: Sequence[str],
    gripper: Mapping[str, Any] | None,
    mark: Mapping[str, Any],
    table: Mapping[str, Any],
    base: Numbers,
    speed: Numbers | None,
    acceleration: Numbers,
    force: Numbers,
    rate: int,
    iterations: int,
    stiffness: float,
    behind: float,
    period: float,
    thing: Can | None,
) -> BulletArm:
    """An arm in a PyBullet world of its own; see `World` and `BulletArm` for the values."""
    refuse_part_of_a_substep(period, rate)
    world = World(
        urdf=urdf,
        joints=tuple(joints),
        fingers=None if gripper is None else Fingers(**_frozen_values(gripper)),
        mark=Mark(**_frozen_values(mark)),
        table=Table(**_frozen_values(table)),
        base=(base[0], base[1], base[2]),
        rate=rate,
        iterations=iterations,
        force=tuple(force),
        can=thing,
    )
    body = body_of(name, urdf, joints, base, speed, acceleration)
    return BulletArm(world, body, stiffness, behind)


def refuse_part_of_a_substep(period: float, rate: int) -> None:
    """Refuse a control `period` [s] that is no whole number of physics steps at `rate` [Hz]."""
    substeps = period * rate
    whole = max(round(substeps), 1)
    if abs(substeps - whole) > ROUNDING:
        raise ValueError(
            f"period={period:g} s is {substeps:.9g} physics steps at robot.arm.rate={rate} Hz, "
            f"not a whole number of them; type period={whole / rate:.9g}"
        )


def ideal_arm(
    name: str,
    urdf: str,
    joints: Sequence[str],
    mark: Mapping[str, Any],
    base: Numbers,
    speed: Numbers | None,
    acceleration: Numbers,
) -> IdealArm:
    """A kinematic arm with the geometry of a URDF."""
    point = (str(mark["link"]), np.asarray(mark["offset"], dtype=float))
    chain = KinematicChain(find_urdf(urdf), tuple(joints), [point], np.asarray(base, dtype=float))
    body = body_of(name, urdf, joints, base, speed, acceleration)
    return IdealArm(body, chain, float(mark["radius"]), pixel(mark["colour"]))


def head_camera(
    arm: BulletArm | IdealArm,
    space: VisualSpace,
    rng: np.random.Generator,
    demonstrator: Demonstrator | None,
    eye: Numbers,
    gaze: Numbers,
    delay_frames: int,
    noise_px: float,
) -> SimulatedCamera:
    """The simulated camera on its neck, looking at the world of `arm`."""
    scene: Scene = arm.scene
    return SimulatedCamera(
        scene, space, np.asarray(eye), np.asarray(gaze), delay_frames, noise_px, rng, demonstrator
    )


def guard_of(
    body: Body,
    margin: float,
    least_clearance: float,
    late: float,
    urdf: str,
    base: Numbers,
    head: Numbers,
    points: Sequence[Mapping[str, Any]],
    trunk: Sequence[Mapping[str, Any]],
    table_height: float,
    base_radius: float,
    base_height: float,
    head_radius: float,
) -> Guard:
    """The guard of an arm over a table, below a camera at `head` (3,) [m].

    `points` along the arm and of its `trunk` are {link, at [m], radius [m]}; those of links that
    a joint joins need not keep apart.
    """
    if np.any(2 * margin >= body.upper - body.lower):
        raise ValueError(f"robot.guard.margin={margin:g} rad leaves a joint no room to move")
    path, both = find_urdf(urdf), (*points, *trunk)
    followed = [(str(point["link"]), np.asarray(point["at"], dtype=float)) for point in both]
    joined = {(joint.parent, joint.child) for joint in read_joints(path).values()}
    joined |= {(child, parent) for parent, child in joined}
    ways = [[(a["link"], b["link"]) for b in trunk] for a in points]
    around = AroundArm(
        chain=KinematicChain(path, body.joint_names, followed, np.asarray(base, dtype=float)),
        radii=np.array([float(point["radius"]) for point in points]),
        trunk_radii=np.array([float(point["radius"]) for point in trunk]),
        apart=np.array([[a != b and (a, b) not in joined for a, b in row] for row in ways]),
        table_height=table_height,
        base=np.asarray(base[:2]),
        base_radius=base_radius,
        base_height=base_height,
        head=np.asarray(head),
        head_radius=head_radius,
    )
    return Guard(
        lower=body.lower,
        upper=body.upper,
        speed=body.speed,
        acceleration=body.acceleration,
        margin=margin,
        surroundings=around,
        least_clearance=least_clearance,
        late=late,
    )


def _frozen_values(node: Mapping[str, Any]) -> dict[str, Any]:
    return {key: _frozen(value) for key, value in node.items()}


def _frozen(value: Any) -> Any:
    if isinstance(value, Sequence) and not isinstance(value, str):
        return tuple(_frozen(one) for one in value)
    return value
