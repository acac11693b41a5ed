"""An arm of bus servos: a driver and what it is told to do, proven on an emulated bus."""

import numpy as np
import pytest
from on_bench import bench
from servo_wired import IDS, PERIOD, Wired, wired

from cli.stages import learning
from imitation.device import DeviceError
from imitation.robots.servo_bus import STEP
from imitation.robots.servo_bus_emulator import HIGHEST, LOWEST, TORQUE_ON, ServoBusEmulator

SLOWLY = np.array([0.3, -0.2, 0.1, 0.0, -0.3])  # [rad/s]


def here(arm: Wired):
    return arm.read().posture


def test_nothing_moves_and_no_torque_is_on_before_the_first_reset(tmp_path):
    with wired(tmp_path) as arm:
        arm.read()
        assert not any(servo.table[TORQUE_ON] for servo in arm.servos.servos.values())


def test_the_arm_begins_where_it_is_and_the_jaws_servo_is_left_alone(tmp_path):
    servos = ServoBusEmulator()
    servos.servos[2].position = 2500.0
    with wired(tmp_path, servos=servos) as arm:
        arm.reset(here(arm))
        assert servos.servos[2].position == 2500.0
        assert [servos.servos[one].table[TORQUE_ON] for one in (*IDS, 6)] == [1, 1, 1, 1, 1, 0]


@pytest.mark.parametrize("senses", [(1, 1, 1, 1, 1), (-1, 1, -1, 1, -1)])
def test_each_joint_moves_by_velocity_times_time_whichever_way_its_servo_counts(tmp_path, senses):
    with wired(tmp_path, senses=senses) as arm:
        arm.reset(np.zeros(5))
        for _ in range(25):
            arm.move(SLOWLY, None, PERIOD)
        assert here(arm) == pytest.approx(SLOWLY, abs=2 * STEP)
        turned = [arm.servos.servos[one].position - 2048 for one in IDS]
        assert np.sign(turned) == pytest.approx(np.sign(SLOWLY * senses))


def test_no_target_leaves_the_limits_of_the_joints_or_of_the_servos(tmp_path):
    servos = ServoBusEmulator()
    servos.servos[1].put(LOWEST, 1900)
    servos.servos[1].put(HIGHEST, 2200)
    with wired(tmp_path, servos=servos) as arm:
        arm.reset(np.zeros(5))
        assert arm.body.upper[0] == pytest.approx((2200 - 2048) * STEP)
        assert arm.body.upper[1] == pytest.approx(1.74533)
        for _ in range(100):
            arm.move(np.full(5, 1.2), None, PERIOD)
        assert here(arm) == pytest.approx(arm.body.upper, abs=2 * STEP)


@pytest.mark.parametrize("fault", ["silence@1x2", "wrong_crc@1x2", "split@1x20", "late@1x1"])
def test_a_bus_that_recovers_is_asked_again(tmp_path, fault):
    with wired(tmp_path, fault) as arm:
        arm.reset(np.zeros(5))
        for _ in range(40):
            arm.move(0.5 * SLOWLY, None, PERIOD)
            arm.read()
        assert here(arm) == pytest.approx(0.8 * SLOWLY, abs=2 * STEP)


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ("silence@1", "do not answer"),
        ("cut@1", "do not answer"),
        ("stuck_servo=1@0", "shoulder_pan is .* from where it was sent"),
        ("hot_servo=3@1", "servo 3 .* temperature"),
        ("overloaded_servo=5@1", "servo 5 .* overload"),
    ],
)
def test_a_fault_that_stays_is_told_in_a_sentence(tmp_path, fault, told):
    with wired(tmp_path, fault) as arm:
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
        assert all(arm.servos.servos[one].table[TORQUE_ON] for one in IDS)


def test_16_areas_are_learned_over_the_wire(tmp_path):
    with wired(tmp_path) as arm:
        parts = bench("learn-map", "robot=so101_sim")
        parts.__dict__["arm"] = arm
        learner, samples = learning(parts)
        for _ in samples:
            pass
        assert learner.learned.learned.sum() == 16
