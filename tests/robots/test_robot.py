"""What a stage may rely on, whatever the body."""

from itertools import pairwise

import numpy as np
import pytest
from on_bench import bench

from imitation.robot import Command

# How far the arm may lag behind its commands [rad], be faster than them [share], and brake harder
# than it should before a joint limit that came earlier than it should [share].
LAG = {"ideal": 1e-12, "katana_sim": 0.004, "kuka_sim": 0.001, "so101_sim": 0.001}
FASTER = {"ideal": 1e-9, "katana_sim": 0.02, "kuka_sim": 0.02, "so101_sim": 0.02}
EARLIER = {"ideal": 1e-9, "katana_sim": 0.001, "kuka_sim": 0.001, "so101_sim": 0.001}
BODIES = list(LAG)
NOTHING_TO_LOSE = (np.nan, np.inf, -np.inf, 1e308, -1e308, 50.0, -50.0, 0.0)  # [rad/s]


@pytest.fixture(scope="module", params=BODIES)
def body(request):
    return request.param


@pytest.fixture(scope="module")
def robot(body):
    robot = bench("learn-map", f"robot={body}").robot
    yield robot
    robot.close()


def still(robot) -> Command:
    return Command(np.zeros(len(robot.home)))


def random_commands(robot, steps: int) -> list[Command]:
    rng = np.random.default_rng(5)
    return [Command(rng.uniform(-0.4, 0.4, len(robot.home))) for _ in range(steps)]


def ride(robot, commands) -> list:
    """All that is sensed from a reset on."""
    return [robot.reset(), *(robot.step(command)[0] for command in commands)]


def test_time_advances_by_one_period_a_step_and_never_goes_back_at_a_reset(robot):
    seen = [one for _ in range(3) for one in ride(robot, random_commands(robot, 4))]
    assert {after.time_ns - before.time_ns for before, after in pairwise(seen)} == {40_000_000}


def test_the_first_reset_is_time_0(body):
    robot = bench("learn-map", f"robot={body}").robot
    assert robot.reset().time_ns == 0
    robot.close()


def test_after_a_reset_the_arm_rests_in_the_posture_asked_for(robot):
    asked = robot.home + 0.05
    for posture, wanted in ((asked, asked), (None, robot.home)):
        seen = robot.reset(posture)
        assert seen.posture == pytest.approx(wanted, abs=1e-9)
        assert not seen.velocity.any()


def test_a_posture_beyond_the_limits_is_refused_by_joint(robot):
    beyond = robot.home.copy()
    beyond[1] = robot.body.upper[1] + 0.1
    with pytest.raises(ValueError, match="joint 2"):
        robot.reset(beyond)


def test_a_velocity_moves_each_joint_by_velocity_times_time(robot, body):
    for joint in range(len(robot.home)):
        velocity = np.zeros(len(robot.home))
        velocity[joint] = 0.05  # [rad/s]: slow enough to need no ramp
        start = robot.reset().posture
        for step in range(1, 11):
            seen, applied = robot.step(Command(velocity))
            assert applied.limited == pytest.approx(velocity)
            assert seen.posture == pytest.approx(start + velocity * 0.04 * step, abs=LAG[body])


def test_what_was_applied_is_told_with_its_reason(robot):
    robot.reset()
    wanted = np.full(len(robot.home), 50.0)
    seen, applied = robot.step(Command(wanted))
    assert applied.requested is wanted
    assert applied.reasons[:2] == ("speed", "acceleration")
    assert applied.sent == pytest.approx(applied.limited)
    assert applied.time_ns == seen.time_ns - robot.period_ns


@pytest.mark.parametrize("seed", [5, 12])  # these lead to table and joint limits at once
def test_whatever_is_asked_speed_acceleration_and_joint_limits_are_kept(robot, body, seed):
    rng, limits = np.random.default_rng(seed), robot.body
    before, seen, margin = np.zeros(len(robot.home)), robot.reset(), robot.guard.margin - 0.001
    largest_change = limits.acceleration * robot.period * (1 + EARLIER[body])
    for step in range(300):
        if step % 7 == 0:
            wanted = rng.choice(NOTHING_TO_LOSE, len(robot.home))
            wanted = wanted if rng.random() < 0.5 else np.nan_to_num(wanted, posinf=9, neginf=-9)
        after, applied = robot.step(Command(wanted))
        assert (np.abs(applied.limited) <= limits.speed + 1e-9).all()
        assert (np.abs(applied.limited - before) <= largest_change).all()
        moved = np.abs(after.posture - seen.posture) / robot.period
        assert (moved <= limits.speed * (1 + FASTER[body])).all()
        assert (after.posture >= limits.lower + margin).all()
        assert (after.posture <= limits.upper - margin).all()
        before, seen = applied.limited, after


def test_an_arm_told_nothing_but_nan_stays_where_it_is(robot):
    start = robot.reset().posture
    for _ in range(10):
        seen, applied = robot.step(Command(np.full(len(robot.home), np.nan)))
        assert applied.reasons == ("not a number",)
        assert not applied.sent.any()
    assert seen.posture == pytest.approx(start, abs=0.001)


def drift(robot, seconds: float) -> float:
    """How far any joint gets while told to hold its posture [rad]."""
    start, farthest = robot.reset().posture, 0.0
    for _ in range(round(seconds / robot.period)):
        seen, _ = robot.step(still(robot))
        farthest = max(farthest, float(np.abs(seen.posture - start).max()))
    return farthest


def test_a_zero_command_holds_the_posture(robot):
    assert drift(robot, 5.0) < 0.005


@pytest.mark.slow
def test_a_zero_command_holds_the_posture_for_a_minute(robot):
    assert drift(robot, 60.0) < 0.005


def test_a_movement_ended_by_a_zero_command_comes_to_rest_where_its_commands_led(robot, body):
    start, velocity = robot.reset().posture, np.full(len(robot.home), 0.04)
    for command in [Command(velocity)] * 25 + [still(robot)] * 25:
        seen, _ = robot.step(command)
    assert seen.posture == pytest.approx(start + velocity, abs=LAG[body])
    assert seen.velocity == pytest.approx(0, abs=0.001)


def test_the_same_seed_twice_is_the_same_down_to_the_last_bit(body):
    both = []
    for _ in range(2):
        robot = bench("learn-map", f"robot={body}", seed=3).robot
        both.append(ride(robot, random_commands(robot, 20)))
        robot.close()
    for one, other in zip(*both, strict=True):
        assert one.frame.tobytes() == other.frame.tobytes()
        for name in ("posture", "velocity", "gaze", "place_noise"):
            assert getattr(one, name).tobytes() == getattr(other, name).tobytes()


def test_a_second_episode_is_the_same_as_the_first(robot):
    first, second = (ride(robot, random_commands(robot, 20)) for _ in range(2))
    for one, other in zip(first, second, strict=True):
        assert one.frame.tobytes() == other.frame.tobytes()
        assert one.posture.tobytes() == other.posture.tobytes()


def test_another_seed_is_other_camera_noise(body):
    noise = []
    for seed in (0, 1):
        robot = bench("learn-map", f"robot={body}", seed=seed).robot
        noise.append(robot.reset().place_noise)
        robot.close()
    assert (noise[0] != noise[1]).all()


def test_a_frame_comes_as_many_steps_late_as_the_camera_is_with_its_own_time(body):
    delay, seen = 3, {}
    for frames in (0, delay):
        robot = bench("learn-map", f"robot={body}", f"camera.delay_frames={frames}").robot
        ride(robot, random_commands(robot, 2))
        seen[frames] = ride(robot, random_commands(robot, 12))
        robot.close()
    for step, late in enumerate(seen[delay]):
        captured = seen[0][max(step - delay, 0)]
        assert captured.time_ns == captured.frame_time_ns == late.frame_time_ns
        assert late.frame.tobytes() == captured.frame.tobytes()
        assert late.place_noise.tobytes() == captured.place_noise.tobytes()
        assert late.time_ns == seen[0][step].time_ns
        assert late.posture == pytest.approx(seen[0][step].posture)


def test_the_truth_of_every_sensing_is_told_once(robot):
    robot.truth()
    seen = ride(robot, random_commands(robot, 3))
    assert [truth.time_ns for truth in robot.truth()] == [one.time_ns for one in seen]
    assert robot.truth() == []


def test_closing_twice_is_harmless(body):
    robot = bench("learn-map", f"robot={body}").robot
    robot.reset()
    robot.close()
    robot.close()


@pytest.mark.parametrize("simulated", ["katana_sim", "kuka_sim", "so101_sim"])
@pytest.mark.parametrize(("period", "instead"), [(0.033, "0.032"), (0.001, "0.004")])
def test_a_period_that_is_no_whole_number_of_physics_steps_is_refused(simulated, period, instead):
    parts = bench("learn-map", f"robot={simulated}", f"period={period}")
    with pytest.raises(ValueError, match=rf"period={period} .*rate=250 Hz.*period={instead}$"):
        parts.robot  # noqa: B018


def test_a_period_may_be_rounded_to_nanoseconds():
    parts = bench("learn-map", "robot=katana_sim", "robot.arm.rate=240", "period=0.0333333333")
    robot = parts.robot
    robot.reset()
    assert robot.step(still(robot))[0].time_ns == 33_333_333
    robot.close()
