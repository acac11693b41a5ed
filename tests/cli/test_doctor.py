"""imitate doctor: what works here, and what of a robot's devices."""

import json

import pytest
from emulated import katana_device, served

from imitation.robots.servo_bus_emulator import ServoBusEmulator


def found(result) -> dict[str, dict]:
    return {one["subject"]: one for one in json.loads(result.stdout)}


def test_a_healthy_installation_passes(imitate):
    result = imitate("doctor", "--json")
    assert result.exit_code == 0
    assert {"python", "packages", "renderer", "viewer", "disk"} <= set(found(result))
    assert not list(imitate.folder.iterdir())


def test_people_are_shown_a_table(imitate):
    shown = imitate("doctor").stdout
    assert "looked at" in shown
    assert "pass" in shown


@pytest.mark.parametrize("robot", ["ideal", "katana_sim"])
def test_a_simulated_robot_passes(imitate, robot):
    result = imitate("doctor", f"robot={robot}", "--json")
    assert result.exit_code == 0
    assert all(one["verdict"] != "fail" for one in found(result).values())
    assert "hand at" in found(result)["camera"]["told"]


def test_the_servos_of_a_bus_tell_how_they_are(imitate):
    servos = ServoBusEmulator()
    with served(servos, imitate.folder / "bus"):
        words = ("robot=so101", "robot.arm.address=bus", "camera.device=/dev/nothing")
        told = found(imitate("doctor", *words, "--json"))
        servos.servos[2].table[13] = 35  # where it gives up
        warm = found(imitate("doctor", *words, "--json"))
    assert told["joints"]["verdict"] == "pass"
    assert told["servos"] == {
        "subject": "servos",
        "verdict": "pass",
        "told": "firmware 3.10, 12.1 to 12.1 V, up to 30 of 70 °C, torque off, limited to 100 %",
        "device": True,
    }
    assert warm["servos"]["verdict"] == "warn"
    assert "let shoulder_lift cool" in warm["servos"]["told"]


def test_a_katana_with_which_no_run_can_begin_fails_unless_it_is_to_be_put_right(imitate):
    with served(katana_device("400", "uncalibrated")) as where:
        words = ("robot=katana", f"robot.arm.address={where}", "camera.device=/dev/nothing")
        failed = found(imitate("doctor", *words, "--json"))
        mended = found(imitate("doctor", *words, "robot.arm.driving.calibrate=true", "--json"))
    assert failed["motors"]["verdict"] == "fail"
    assert "robot.arm.driving.calibrate=true" in failed["motors"]["told"]
    assert mended["motors"]["verdict"] == "warn"


def test_devices_that_do_not_answer_are_told_with_what_to_type(imitate):
    words = ("robot=katana", "robot.arm.address=127.0.0.1:1", "neck=ssc32", "neck.port=nowhere")
    result = imitate("doctor", *words, "camera.device=/dev/nothing", "--json")
    assert result.exit_code == 3
    told = found(result)
    for subject, word in (("arm", "address"), ("camera", "camera.device"), ("neck", "nowhere")):
        assert told[subject]["verdict"] == "fail"
        assert word in told[subject]["told"]
    assert "robot.arm.address=" in told["ports"]["told"]


def test_an_unknown_robot_is_bad_input(imitate):
    result = imitate("doctor", "robot=katanna")
    assert result.exit_code == 2
    assert "katana" in result.stderr
