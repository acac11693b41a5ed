"""Whatever is asked of it, on whatever body, nothing beyond a limit reaches the arm."""

from pathlib import Path

import numpy as np
import pytest
from katana_wired import Wire, wired
from on_bench import bench
from servo_wired import wired as wired_servos

from cli.build import Bench
from imitation.arrays import Array
from imitation.gaze import VisualSpace
from imitation.robot import Arm, Command, Robot, Shot

NOTHING_TO_LOSE = (np.nan, np.inf, -np.inf, 1e308, -1e308, 1e-308, 50.0, -50.0, 1.0, -1.0, 0.0)
MEANWHILE = (None, 1e300, -5.0, 0.3, np.nan)  # what is asked of the gripper
ROUNDING = 1e-9
# How much harder it brakes before a limit that came earlier than it should: an arm that is not
# just where its commands led it may be told to stop at once.
EARLIER, AT_ONCE = 1.001, 4.0
# Steps in the normal suite and in the slow one.
STEPS = {
    "ideal": (2000, 1_000_000),
    "katana_sim": (500, 1_000_000),
    "kuka_sim": (300, 1_000_000),
    "so101_sim": (500, 1_000_000),
}
THROUGH_A_WIRE = 300, 50_000  # for each body that has one
ELSEWHERE = 0.005  # in an engine the arm is not just where its commands led it [rad]


class Witness:
    """Stands before an arm and notes every velocity that reaches it."""

    def __init__(self, arm: Arm) -> None:
        self._arm, self.body = arm, arm.body
        self.live = False  # the test keeps its own time
        self.velocity = np.zeros(len(arm.body.lower))

    def reset(self, posture: Array) -> None:
        self._arm.reset(posture)
        self.velocity = np.zeros(len(posture))

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        self.velocity = velocity
        assert grip is None or 0 <= grip <= 1
        return self._arm.move(velocity, grip, period)

    def read(self):
        return self._arm.read()

    def truth(self) -> None:
        return None

    def close(self) -> None:
        self._arm.close()


class TroubledCamera:
    """Shows nothing, and is often in trouble."""

    live = False

    def __init__(self, space: VisualSpace, rng: np.random.Generator) -> None:
        width, height = space.size
        self._frame, self._rng = np.zeros((height, width, 3), np.uint8), rng
        self._trouble: str | None = None

    def look(self, time_ns: int, gaze: Array | None) -> Shot:
        if self._rng.random() < 0.05:
            self._trouble = "stale vision" if self._trouble is None else None
        return Shot(self._frame, time_ns, np.zeros(2), trouble=self._trouble)

    def reset(self, time_ns: int) -> None:
        self._trouble = None

    def locate(self, position: Array) -> Array:
        return np.zeros(2)

    def close(self) -> None:
        pass


def wishes(rng: np.random.Generator, joints: int):
    """Velocities nobody should ask for: each lasts for a while, some change at every step."""
    while True:
        kind, lasts = rng.integers(4), int(rng.integers(1, 40))
        wish = rng.choice(NOTHING_TO_LOSE, joints)
        if kind == 1:
            wish = rng.uniform(-3, 3, joints)
        if kind == 2:
            wish = np.nan_to_num(wish, nan=0.0, posinf=9.0, neginf=-9.0)
        for _ in range(lasts):
            yield rng.uniform(-9, 9, joints) if kind == 3 else wish


def ride(robot: Robot, witness: Witness, steps: int, seed: int, earlier: float) -> None:
    """So many hostile steps; every velocity and place is within its limits."""
    rng, body = np.random.default_rng(seed), witness.body
    asked, largest = wishes(rng, len(body.lower)), body.acceleration * robot.period
    around = robot.guard.surroundings
    before = robot.reset() and witness.velocity
    for step in range(steps):
        seen, applied = robot.step(Command(next(asked), rng.choice(MEANWHILE)))
        velocity = witness.velocity
        assert np.isfinite(velocity).all(), step
        assert (np.abs(velocity) <= body.speed + ROUNDING).all(), step
        brakes = np.abs(velocity) < np.abs(before)
        change = np.abs(velocity - before) / np.where(brakes, earlier, EARLIER)
        assert (change <= largest + ROUNDING).all(), step
        assert (seen.posture >= body.lower - ELSEWHERE).all(), step
        assert (seen.posture <= body.upper + ELSEWHERE).all(), step
        assert around.clearance(seen.posture[None])[0] > 0, step
        if applied.reasons[:1] == ("stale vision",):
            assert (np.abs(velocity) <= np.abs(before) + ROUNDING).all(), step
        before = velocity


def troubled(parts: Bench, arm: Arm) -> tuple[Robot, Witness]:
    """A robot without a camera worth the name, so that many steps take little time."""
    witness = arm if isinstance(arm, Witness) else Witness(arm)
    camera = TroubledCamera(parts.space, np.random.default_rng(1))
    home = parts.guided.mean(axis=0)
    return Robot(witness, camera, parts.guard(arm.body), home, parts.period_ns), witness


@pytest.mark.parametrize("body", STEPS)
def test_nothing_beyond_a_limit_reaches_a_simulated_arm(body):
    simulated_ride(body, STEPS[body][0], seed=7)


@pytest.mark.slow
@pytest.mark.timeout(7200)
@pytest.mark.parametrize("body", STEPS)
def test_nothing_beyond_a_limit_reaches_a_simulated_arm_for_long(body):
    simulated_ride(body, STEPS[body][1], seed=8)


def simulated_ride(body: str, steps: int, seed: int) -> None:
    parts = bench("learn-map", f"robot={body}")
    robot, witness = troubled(parts, parts.robot.arm)
    ride(robot, witness, steps, seed, EARLIER if body == "ideal" else AT_ONCE)
    robot.close()


class Patient(Witness):
    """A witness that lets the wire's time pass after each command."""

    def __init__(self, arm: Arm, wire: Wire) -> None:
        super().__init__(arm)
        self._wire = wire

    def move(self, velocity: Array, grip: float | None, period: float) -> Array:
        sent = super().move(velocity, grip, period)
        self._wire.pass_time(period)
        return sent


MODELS = ("300", "400", "450")


@pytest.mark.parametrize("model", MODELS)
def test_nothing_beyond_a_limit_reaches_the_motors_of_a_katana(model, tmp_path):
    katana_ride(model, THROUGH_A_WIRE[0], tmp_path)


def test_nothing_beyond_a_limit_reaches_the_servos_of_a_bus(tmp_path):
    servo_ride(THROUGH_A_WIRE[0], tmp_path)


@pytest.mark.slow
@pytest.mark.timeout(7200)
@pytest.mark.parametrize("model", MODELS)
def test_nothing_beyond_a_limit_reaches_the_motors_of_a_katana_for_long(model, tmp_path):
    katana_ride(model, THROUGH_A_WIRE[1], tmp_path)


@pytest.mark.slow
@pytest.mark.timeout(7200)
def test_nothing_beyond_a_limit_reaches_the_servos_of_a_bus_for_long(tmp_path):
    servo_ride(THROUGH_A_WIRE[1], tmp_path)


def katana_ride(model: str, steps: int, folder: Path) -> None:
    with wired(model, folder) as (arm, wire, parts):
        arm.reset(arm.body.lower)
        robot, witness = troubled(parts, Patient(arm, wire))
        ride(robot, witness, steps, 9, AT_ONCE)
        share = arm.katana.model.per_radian * 0.01
        assert (wire.fastest[:5] <= np.ceil(np.abs(arm.body.speed * share)) + 1).all()
        robot.close()
        assert arm.katana.connection.repeats == 0


def servo_ride(steps: int, folder: Path) -> None:
    with wired_servos(folder) as arm:
        robot, witness = troubled(bench("learn-map", "robot=so101"), Witness(arm))
        ride(robot, witness, steps, 9, AT_ONCE)
        robot.close()
