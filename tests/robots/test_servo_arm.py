"""An arm of bus servos: a driver and what it is told to do, proven on an emulated bus."""

import numpy as np
import pytest
from on_bench import bench
from servo_wired import IDS, PERIOD, Wired, wired

from cli.stages import learning
from imitation.device import DeviceError
from imitation.grasp import GraspReflex, Hand
from imitation.robots.emulated_servos import (
    HIGHEST,
    LOWEST,
    MAKES,
    SPEED,
    TORQUE_LIMIT,
    TORQUE_ON,
)
from imitation.robots.servo_bus_emulator import ServoBusEmulator
from imitation.robots.servo_kinds import KINDS, STEP

EVERY = pytest.mark.parametrize("kind", KINDS)
SLOWLY = np.array([0.3, -0.2, 0.1, 0.0, -0.3])  # [rad/s]


def here(arm: Wired):
    return arm.read().posture


@EVERY
def test_nothing_moves_and_no_torque_is_on_before_the_first_reset(tmp_path, kind):
    with wired(tmp_path, kind=kind) as arm:
        arm.read()
        assert not any(servo.get(TORQUE_ON) for servo in arm.servos.servos.values())


def test_the_arm_begins_where_it_is_and_the_jaws_servo_is_left_alone(tmp_path):
    servos = ServoBusEmulator()
    servos.servos[2].position = 2500.0
    with wired(tmp_path, servos=servos) as arm:
        arm.reset(here(arm))
        assert servos.servos[2].position == 2500.0
        assert [servos.servos[one].get(TORQUE_ON) for one in (*IDS, 6)] == [1, 1, 1, 1, 1, 0]


@EVERY
@pytest.mark.parametrize("senses", [(1, 1, 1, 1, 1), (-1, 1, -1, 1, -1)])
def test_each_joint_moves_by_velocity_times_time_whichever_way_its_servo_counts(
    tmp_path, senses, kind
):
    with wired(tmp_path, senses=senses, kind=kind) as arm:
        arm.reset(np.zeros(5))
        for _ in range(25):
            arm.move(SLOWLY, None, PERIOD)
        assert here(arm) == pytest.approx(SLOWLY, abs=2 * STEP)
        turned = [arm.servos.servos[one].position - 2048 for one in IDS]
        assert np.sign(turned) == pytest.approx(np.sign(SLOWLY * senses))


@EVERY
def test_no_target_leaves_the_limits_of_the_joints_or_of_the_servos(tmp_path, kind):
    servos = ServoBusEmulator(make=MAKES[kind])
    servos.servos[1].put(LOWEST, 1900)
    servos.servos[1].put(HIGHEST, 2200)
    with wired(tmp_path, servos=servos, kind=kind) as arm:
        arm.reset(np.zeros(5))
        assert arm.body.upper[0] == pytest.approx((2200 - 2048) * STEP)
        assert arm.body.upper[1] == pytest.approx(1.74533)
        for _ in range(100):
            arm.move(np.full(5, 1.2), None, PERIOD)
        assert here(arm) == pytest.approx(arm.body.upper, abs=2 * STEP)


@pytest.mark.parametrize("kind", ["sts3215", "xm430"])
@pytest.mark.parametrize("fault", ["silence@1x2", "wrong_crc@1x2", "split@1x20", "late@1x1"])
def test_a_bus_that_recovers_is_asked_again(tmp_path, fault, kind):
    with wired(tmp_path, fault, kind=kind) as arm:
        arm.reset(np.zeros(5))
        for _ in range(40):
            arm.move(0.5 * SLOWLY, None, PERIOD)
            arm.read()
        assert here(arm) == pytest.approx(0.8 * SLOWLY, abs=2 * STEP)


@pytest.mark.parametrize("kind", ["sts3215", "xl430"])
@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ("silence@1", "do not answer"),
        ("cut@1", "do not answer"),
        ("stuck_servo=1@0", "shoulder_pan is .* from where it was sent"),
        ("stuck_encoder=1@0", "shoulder_pan is .* from where it was sent"),
        ("hot_servo=3@1", "servo 3 .* temperature"),
        ("overloaded_servo=5@1", "servo 5 .* overload"),
    ],
)
def test_a_fault_that_stays_is_told_in_a_sentence(tmp_path, fault, told, kind):
    with wired(tmp_path, fault, kind=kind) as arm:
        arm.reset(np.zeros(5))
        with pytest.raises(DeviceError, match=told):
            for _ in range(80):
                arm.move(SLOWLY, None, PERIOD)
                arm.read()


def test_closing_holds_the_arm_where_it_is_and_is_harmless_when_repeated(tmp_path):
    with wired(tmp_path) as arm:
        arm.reset(np.zeros(5))
        arm.move(np.full(5, 1.0), None, PERIOD)
        arm.close()
        stands = [servo.position for servo in arm.servos.servos.values()]
        arm.servos.clock.now += 1.0
        arm.servos.pass_time()
        after = [servo.position for servo in arm.servos.servos.values()]
        assert after == pytest.approx(stands, abs=1)
        assert all(arm.servos.servos[one].get(TORQUE_ON) for one in IDS)


@EVERY
def test_speed_and_torque_are_limited_in_the_servos_own_units(tmp_path, kind):
    with wired(tmp_path, kind=kind) as arm:
        arm.reset(np.zeros(5))
        make, servo = MAKES[kind], arm.servos.servos[1]
        fastest = servo.get(SPEED) * make.speed_unit * STEP
        assert arm.body.speed[0] <= fastest < arm.body.speed[0] + make.speed_unit * STEP
        assert servo.get(TORQUE_LIMIT) == pytest.approx(0.5 / KINDS[kind].torque.unit, abs=1)


@pytest.mark.parametrize(("kind", "other"), [("xl430", "xm430"), ("xl330", "xl430")])
def test_other_servos_than_were_asked_for_are_refused(tmp_path, kind, other):
    servos = ServoBusEmulator(make=MAKES[other])
    told = r"servo 1 .* is model .* robot\.arm\.servos"
    with pytest.raises(DeviceError, match=told), wired(tmp_path, servos=servos, kind=kind):
        pass


@pytest.mark.parametrize("kind", ["sts3215", "xl430"])
def test_servos_that_are_set_to_turn_for_ever_are_refused(tmp_path, kind):
    servos = ServoBusEmulator(make=MAKES[kind])
    servos.servos[2].table[33 if kind == "sts3215" else 11] = 1
    told = r"servo 2 .* needs position mode"
    with pytest.raises(DeviceError, match=told), wired(tmp_path, servos=servos, kind=kind):
        pass


def grip(arm: Wired, opening: float):
    """What is felt after two seconds of opening or closing."""
    for _ in range(50):
        arm.move(np.zeros(5), opening, PERIOD)
        seen = arm.read()
    return seen


@EVERY
def test_the_jaw_opens_and_closes_and_feels_what_it_closes_on(tmp_path, kind):
    with wired(tmp_path, kind=kind, with_jaw=True) as arm:
        arm.reset(np.zeros(5))
        opened = grip(arm, 1.0)
        assert (opened.opening, opened.touching) == (pytest.approx(1.0, abs=0.01), False)
        assert opened.proximity == 0.03  # it does not see: something may be there
        shut = grip(arm, 0.0)
        assert (shut.opening, shut.touching) == (pytest.approx(0.0, abs=0.01), False)
        assert shut.proximity == float("inf")
        grip(arm, 1.0)
        arm.servos.servos[6].thing = 2048
        held = grip(arm, 0.0)
        assert held.touching
        assert held.proximity == 0.0
        assert 0.4 < held.opening < 0.6
        assert held.posture == pytest.approx(0, abs=2 * STEP)


def test_the_reflex_closes_the_jaw_where_the_arm_arrives_and_opens_it_again(tmp_path):
    reflex = GraspReflex(close_within=0.0, firm=0.1, closing=3.0, opening=2.0)
    with wired(tmp_path, with_jaw=True) as arm:
        arm.reset(np.zeros(5))
        felt = grip(arm, 1.0)
        arm.servos.servos[6].thing = 2048
        assert reflex.feel(0.0, felt.proximity, felt.touching, arrived=False) is None
        wanted = reflex.feel(0.1, felt.proximity, felt.touching, arrived=True)
        felt = grip(arm, wanted)
        assert reflex.feel(2.1, felt.proximity, felt.touching, arrived=True) is None
        assert reflex.hand is Hand.HOLDING
        assert not grip(arm, reflex.release(3.0)).touching


@pytest.mark.parametrize("kind", ["sts3215", "xm430"])
def test_16_areas_are_learned_over_the_wire(tmp_path, kind):
    with wired(tmp_path, kind=kind) as arm:
        parts = bench("learn-map", "robot=so101_sim")
        parts.__dict__["arm"] = arm
        learner, samples = learning(parts)
        for _ in samples:
            pass
        assert learner.learned.learned.sum() == 16
