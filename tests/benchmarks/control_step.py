"""The whole control step of `imitate reach` against the bare loop of the engine."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from pathlib import Path
from time import perf_counter

import numpy as np

from imitation.robots.bullet.arm import BulletArm
from imitation.robots.bullet.photograph import projection_matrix, view_matrix
from imitation.robots.bullet.world import World, pybullet
from imitation.robots.bullet.world_picture import FLAT_LIGHT
from imitation.robots.bullet.world_table import add_seen
from tests.benchmarks.figure import Figure
from tests.benchmarks.reaching import Reach, learn_map

ROUNDS = 12
STEPS = 250  # of each round
TRIALS = 12
BLOCK = 25  # steps of which the best round counts; each closes a chunk of the recording, or two
CONTROLLERS = ("corrected_aim", "yuragi")


def figures(folder: Path) -> Iterator[Figure]:
    """The step of each controller against the bare loop, and the recorder's share of it."""
    learn_map(folder)
    for controller in CONTROLLERS:
        rounds = zip(*_rounds(folder, controller), strict=True)
        whole, unrecorded, bare, tableless = (best(times) * 1e3 for times in rounds)
        detail = (
            f"{whole:.2f} ms / {bare:.2f} ms; {whole / tableless:.2f} times a bare loop "
            f"whose picture lacks the table, {tableless:.2f} ms"
        )
        yield Figure(f"control_step_{controller}", whole / bare, "times", 1.5, detail)
        detail = f"{whole:.2f} ms with it, {unrecorded:.2f} ms without"
        share = max(0.0, whole - unrecorded) / whole
        yield Figure(f"recorder_share_{controller}", 100 * share, "%", 10.0, detail)


def best(rounds: Sequence[Sequence[float]]) -> float:
    """Mean time of a step when each block of steps is taken from its best round [s].

    Every round takes the same steps, so what differs between them is how busy the machine was.
    """
    times = np.array(rounds)
    blocks = times[:, : times.shape[1] // BLOCK * BLOCK].reshape(len(times), -1, BLOCK)
    return float(blocks.mean(axis=-1).min(axis=0).mean())


def _rounds(folder: Path, controller: str) -> Iterator[tuple[list[float], ...]]:
    """Time of each step [s]: whole, unrecorded, bare, bare without a table in its picture.

    They are interleaved, the first two block by block, so that all have equal luck.
    """
    for number in range(ROUNDS):
        runs = [
            Reach(folder / f"{controller}-{number}-{way}", controller, TRIALS, STEPS)
            for way in ("whole", "unrecorded")
        ]
        whole, unrecorded = runs
        side_by_side(whole.stepping(recorded=True), unrecorded.stepping(recorded=False))
        bare = bare_step_times(whole, with_table), bare_step_times(whole, as_it_is)
        yield whole.step_times, unrecorded.step_times, *bare
        for run in runs:
            run.bench.robot.close()


def side_by_side(one: Iterator[None], other: Iterator[None]) -> None:
    """Take both to their ends, a block of the one, a block of the other."""
    for _ in range(STEPS // BLOCK):
        for steps in (one, other):
            deque(islice(steps, BLOCK), maxlen=0)
        one, other = other, one  # neither is always the first
    for steps in (one, other):
        deque(steps, maxlen=0)


def as_it_is(world: World) -> None:
    """Our camera lays the table behind the engine's picture: the engine does not draw it."""


def with_table(world: World) -> None:
    """Let the engine draw the table, as a loop of its own would, so that the picture is whole."""
    add_seen(world.table, world._client)


def bare_step_times(reach: Reach, prepare: Callable[[World], None]) -> list[float]:
    """Wall time of the least that each simulated step needs, on the same movements [s].

    Set velocities, substeps, read joints, render: nothing is made of what comes back. `prepare`
    is done to each new world.
    """
    robot, camera = reach.bench.robot, reach.cfg["camera"]
    assert isinstance(robot.arm, BulletArm)
    world = robot.arm.world
    client, arm, joints = world._client, world._arm, world._joints
    substeps = round(robot.period * world.rate)
    space = reach.bench.space
    view = view_matrix(camera["eye"], camera["gaze"]).tolist()
    picture = (*space.size, view, projection_matrix(space).tolist())
    times = []
    for movement in reach.movements:
        if movement.start is not None:
            robot.reset(movement.start)
            prepare(world)
        velocity = movement.velocity.tolist()
        start = perf_counter()
        pybullet.setJointMotorControlArray(
            arm,
            joints,
            pybullet.VELOCITY_CONTROL,
            targetVelocities=velocity,
            forces=world.force,
            physicsClientId=client,
        )
        for _ in range(substeps):
            pybullet.stepSimulation(physicsClientId=client)
        pybullet.getJointStates(arm, joints, physicsClientId=client)
        pybullet.getCameraImage(*picture, physicsClientId=client, **FLAT_LIGHT)
        times.append(perf_counter() - start)
    return times
