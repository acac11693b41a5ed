"""What no command may make the arm do."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from on_bench import bench

from imitation.arrays import Array
from imitation.guard import Guard
from imitation.robots.around_arm import AroundArm

PERIOD = 0.04  # [s]
JOINTS = 5
GUARD = Guard(
    lower=np.array([-3.0, -0.3, -2.2, -2.0, -3.0]),
    upper=np.array([3.0, 2.2, 2.1, 2.0, 3.0]),
    speed=np.array([2.2, 1.2, 1.2, 2.2, 2.2]),
    acceleration=np.array([12.0, 6.0, 2.0, 12.0, 20.0]),
    margin=0.02,
    surroundings=None,
    least_clearance=0.0,
    late=0.0,
)

hostile = arrays.arrays(
    np.float64,
    JOINTS,
    elements=st.one_of(
        st.floats(-3.0, 3.0),
        st.sampled_from([0.0, 1e3, -1e3, 1e308, -1e308, np.inf, -np.inf, np.nan]),
    ),
)
# A wish that lasts drives the arm into its limits; one that changes shakes it.
wishes = st.lists(st.tuples(hostile, st.integers(1, 60)), min_size=1, max_size=6)
starts = arrays.arrays(np.float64, JOINTS, elements=st.floats(0.1, 0.9)).map(
    lambda share: GUARD.lower + share * (GUARD.upper - GUARD.lower)
)


@dataclass(frozen=True)
class Ride:
    """What an ideal arm does under the guard."""

    postures: Array  # (steps + 1, n_joints) [rad]
    velocities: Array  # (steps + 1, n_joints) [rad/s], the first at rest


def ride(guard: Guard, start: Array, wanted: Sequence[tuple[Array, int]]) -> Ride:
    """An ideal arm, as late as the guard knows, that is asked for each velocity for so long."""
    postures, velocities = [start], [np.zeros(JOINTS)]
    for wish, periods in wanted:
        for _ in range(periods):
            sensed = postures[-1] - velocities[-1] * guard.late
            limited, _ = guard.limit(wish, velocities[-1], sensed, PERIOD)
            velocities.append(limited)
            postures.append(postures[-1] + limited * PERIOD)
    return Ride(np.array(postures), np.array(velocities))


@given(starts, wishes)
def test_whatever_is_asked_no_limit_is_ever_exceeded(start, wanted):
    done = ride(GUARD, start, wanted)
    assert np.isfinite(done.velocities).all()
    assert (np.abs(done.velocities) <= GUARD.speed + 1e-9).all()
    assert (np.abs(np.diff(done.velocities, axis=0)) <= GUARD.acceleration * PERIOD + 1e-9).all()
    assert (done.postures >= GUARD.lower + GUARD.margin - 1e-9).all()
    assert (done.postures <= GUARD.upper - GUARD.margin + 1e-9).all()


@given(starts, wishes)
def test_after_any_ride_the_arm_can_brake_to_a_stop_before_its_limits(start, wanted):
    done = ride(GUARD, start, [*wanted, (np.zeros(JOINTS), 60)])
    assert not done.velocities[-1].any()
    assert (done.postures[-1] >= GUARD.lower + GUARD.margin - 1e-9).all()
    assert (done.postures[-1] <= GUARD.upper - GUARD.margin + 1e-9).all()


@settings(max_examples=20)
@given(starts, st.sampled_from([-1.0, 1.0]))
def test_a_limit_is_reached_but_for_its_margin(start, direction):
    done = ride(GUARD, start, [(direction * GUARD.speed, 200)])
    end = GUARD.upper - GUARD.margin if direction > 0 else GUARD.lower + GUARD.margin
    np.testing.assert_allclose(done.postures[-1], end, atol=1e-3)


def test_a_harmless_command_passes_as_it_is():
    wanted = np.array([0.1, -0.05, 0.02, 0.0, 0.2])
    limited, reasons = GUARD.limit(wanted, np.zeros(JOINTS), np.zeros(JOINTS), PERIOD)
    assert limited.tolist() == wanted.tolist()
    assert reasons == ()


def test_too_fast_a_command_is_slowed_along_its_direction():
    wanted = np.array([4.4, 1.2, 0.0, 0.0, 0.0])
    limited, reasons = GUARD.limit(wanted, wanted / 2, np.zeros(JOINTS), PERIOD)
    assert limited == pytest.approx(wanted / 2)
    assert reasons == ("speed",)


def test_a_jump_becomes_a_ramp_that_keeps_to_its_line():
    wanted = np.array([1.0, 0.0, -1.0, 0.0, 0.0])
    limited, reasons = GUARD.limit(wanted, np.zeros(JOINTS), np.zeros(JOINTS), PERIOD)
    assert limited == pytest.approx([0.08, 0.0, -0.08, 0.0, 0.0])
    assert reasons == ("acceleration",)


def test_an_arm_that_must_brake_does_so_with_each_joint_as_hard_as_it_can():
    before, nothing = np.array([1.0, 0.0, -1.0, 0.0, 0.0]), np.full(JOINTS, np.nan)
    limited, _ = GUARD.limit(nothing, before, np.zeros(JOINTS), PERIOD)
    assert limited == pytest.approx([0.52, 0.0, -0.92, 0.0, 0.0])


def test_at_the_limit_only_the_way_back_is_open():
    posture = np.zeros(JOINTS)
    posture[1] = GUARD.upper[1]
    further, back = np.zeros(JOINTS), np.zeros(JOINTS)
    further[1], back[1] = 0.1, -0.1
    stopped, reasons = GUARD.limit(further, np.zeros(JOINTS), posture, PERIOD)
    assert not stopped.any()
    assert reasons == ("joint limit",)
    assert GUARD.limit(back, np.zeros(JOINTS), posture, PERIOD)[0].tolist() == back.tolist()


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_command_that_is_no_number_brakes_the_arm(bad):
    wanted, before = np.full(JOINTS, 0.1), np.full(JOINTS, 0.05)
    wanted[2] = bad
    limited, reasons = GUARD.limit(wanted, before, np.zeros(JOINTS), PERIOD)
    assert not limited.any()
    assert reasons == ("not a number",)


def test_a_joint_that_cannot_be_read_brakes_the_arm():
    posture = np.zeros(JOINTS)
    posture[3] = np.nan
    limited, reasons = GUARD.limit(np.full(JOINTS, 0.1), np.full(JOINTS, 0.05), posture, PERIOD)
    assert not limited.any()
    assert reasons == ("not a number",)


@pytest.mark.parametrize("joint", range(JOINTS))
def test_a_start_posture_beyond_a_limit_is_refused_by_joint(joint):
    posture = np.zeros(JOINTS)
    posture[joint] = GUARD.upper[joint] + 0.01
    with pytest.raises(ValueError, match=f"joint {joint + 1} of the start posture"):
        GUARD.posture_within_limits(posture)


def test_a_start_posture_must_be_numbers_and_may_lie_on_a_limit():
    with pytest.raises(ValueError, match="finite"):
        GUARD.posture_within_limits(np.full(JOINTS, np.nan))
    assert GUARD.posture_within_limits(GUARD.upper) is GUARD.upper


@dataclass(frozen=True)
class Wall:
    """The first three joints must not add up to more than 1; a slanted wall in joint space."""

    def clearance(self, postures: Array) -> Array:
        return 1.0 - postures[:, :3].sum(axis=1)


WALLED = replace(GUARD, surroundings=Wall(), least_clearance=0.1)
before_the_wall = starts.map(lambda posture: posture - max(posture[:3].sum() - 0.8, 0.0) / 3)


def test_a_way_that_ends_too_near_is_braked_with_its_reason():
    posture, before = np.array([0.8, 0.05, 0.0, 0.0, 0.0]), np.array([1.0, 0, 0, 0, 0])
    limited, reasons = WALLED.limit(before, before, posture, PERIOD)
    assert limited == pytest.approx([1.0 - 12.0 * PERIOD, 0, 0, 0, 0])
    assert reasons == ("surroundings",)


def test_from_too_near_the_way_out_is_open():
    posture, wanted = np.array([0.95, 0.0, 0.0, 0.0, 0.0]), np.array([-0.3, 0, 0, 0, 0])
    limited, reasons = WALLED.limit(wanted, np.zeros(JOINTS), posture, PERIOD)
    assert limited.tolist() == wanted.tolist()
    assert reasons == ()


def within_joint_limits(guard: Guard, done: Ride) -> bool:
    lowest, highest = guard.lower + guard.margin - 1e-6, guard.upper - guard.margin + 1e-6
    return bool(((done.postures >= lowest) & (done.postures <= highest)).all())


@settings(max_examples=200)
@given(before_the_wall, wishes, st.sampled_from([0.0, 0.1]))
def test_whatever_is_asked_the_arm_keeps_clear_of_a_wall(start, wanted, late):
    done = ride(replace(WALLED, late=late), start, wanted)
    assert Wall().clearance(done.postures).min() >= WALLED.least_clearance - 1e-9


SLOW, QUICK = 2, 4  # of the joints: the last brakes ten times as hard as the third


@dataclass(frozen=True)
class Slant:
    """The third and the last joint must not add up to more than 1."""

    def clearance(self, postures: Array) -> Array:
        return 1.0 - postures[:, QUICK] - postures[:, SLOW]


def test_braking_in_proportion_before_a_wall_does_not_carry_a_joint_beyond_its_limit():
    @dataclass(frozen=True)
    class Ceiling:
        def clearance(self, postures: Array) -> Array:
            return 1.0 - postures[:, SLOW]

    guard = replace(GUARD, surroundings=Ceiling(), least_clearance=0.1)
    start, rise = np.zeros(JOINTS), np.zeros(JOINTS)
    start[SLOW], start[QUICK] = 0.2, 2.5
    rise[SLOW], rise[QUICK] = 1.2, 1.2
    done = ride(guard, start, [(rise, 40)])
    assert guard.surroundings.clearance(done.postures).min() >= 0.1 - 1e-9
    assert within_joint_limits(guard, done)


def test_joints_that_brake_at_different_rates_do_not_dip_into_the_wall_on_their_way_to_rest():
    guard = replace(GUARD, surroundings=Slant(), least_clearance=0.1)
    approach, dive = np.zeros(JOINTS), np.zeros(JOINTS)
    approach[SLOW] = -1.2
    dive[SLOW], dive[QUICK] = -1.2, 2.2
    start = np.zeros(JOINTS)
    start[SLOW], start[QUICK] = 1.4, -0.8
    done = ride(guard, start, [(approach, 16), (dive, 40)])
    assert guard.surroundings.clearance(done.postures).min() >= 0.1 - 1e-9


def test_an_arm_a_little_farther_than_it_was_led_still_brakes_clear_of_a_wall():
    guard = replace(GUARD, surroundings=Slant(), least_clearance=0.1)
    before, posture = np.zeros(JOINTS), np.zeros(JOINTS)
    before[SLOW], before[QUICK] = 0.8, -0.8
    braking = sum(0.08 * count * PERIOD for count in range(10))  # 0.8 rad/s in steps of 0.08
    posture[SLOW] = guard.upper[SLOW] - guard.margin - braking + 1e-4
    posture[QUICK] = 0.9 - posture[SLOW]
    limited, _ = guard.limit(np.full(JOINTS, np.nan), before, posture, PERIOD)
    assert limited == pytest.approx(0.9 * before)


@pytest.fixture(scope="module")
def katana() -> AroundArm:
    parts = bench("learn-map", "robot=ideal")
    around = parts.guard(parts.body).surroundings
    assert isinstance(around, AroundArm)
    return around


# What is no number arrives while only braking in proportion keeps clear.
@example([(np.array([0.0, 0.0, -1.0, -1.0, 0.0]), 9), (np.full(JOINTS, np.inf), 4)])
@settings(max_examples=40, deadline=None)
@given(wishes)
def test_whatever_is_asked_the_katana_keeps_clear_of_table_trunk_and_head(katana, wanted):
    guard = replace(GUARD, surroundings=katana, least_clearance=0.02)
    home = np.array([0.28, 1.24, -1.49, 0.85, 0.0])
    assert katana.clearance(home[None]) > 0.02
    done = ride(guard, home, wanted)
    assert katana.clearance(done.postures).min() >= 0.02 - 1e-6
    assert within_joint_limits(guard, done)
