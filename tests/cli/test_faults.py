"""Faults have defined answers: docs/hardware.md says them, whole runs in simulation show them."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from cli.emulate import DEVICES
from cli.keys import groups
from cli.twin import NECK_FAULTS
from cli.verify import verify
from imitation.recording import messages
from imitation.recording.mcap_recording import Recording
from imitation.recording.recorded_steps import steps_told
from imitation.robots.twin import CAMERA_FAULTS

PAGE = (Path(__file__).parents[2] / "docs" / "hardware.md").read_text()
FAULTS = sorted(set(groups()["fault"]) - {"none"})
EMULATED = set(CAMERA_FAULTS | NECK_FAULTS).union(*DEVICES.values()) - {"reset"}
SOON_OVER = "0.4"  # [s]


@dataclass(frozen=True)
class Answer:
    """A row of the table."""

    simulated: list[str]
    emulated: list[str]
    event: str
    why: str  # the guard's reason
    soon_over: int  # exit codes
    for_good: int


def _answers() -> list[Answer]:
    table = PAGE.split("| fault | `fault=`")[1].split("\n\n")[0]
    found = []
    for line in table.splitlines()[2:]:
        _, simulated, emulated, _, event, exits = (
            one.strip() for one in line.strip("|").split("|")
        )
        kind, _, why = event.replace("`", "").partition(": ")
        first, _, last = exits.partition(", ")
        names = (re.findall(r"`(\w+)", cell) for cell in (simulated, emulated))
        found.append(Answer(*names, kind, why, int(first), int(last or first)))
    return found


ANSWERS = _answers()


def answer_to(fault: str) -> Answer:
    (answer,) = (one for one in ANSWERS if fault in one.simulated)
    return answer


def run(imitate, learned, fault: str, lasts: str, trials: int = 1) -> tuple[int, Recording]:
    """Reach while something goes wrong."""
    words = ["fault.at=0.2", f"fault.lasts={lasts}", "reach.limit=3", "seed=3", "out=run"]
    words += [f"trials={trials}"]
    words += ["fault.watch.lost=1.5"] if "camera" in fault else []
    result = imitate("reach", "robot=ideal", f"map={learned}", f"fault={fault}", *words)
    assert "Traceback" not in result.stderr
    if result.exit_code == 3:  # the fixture verifies the others
        assert verify(imitate.folder / "run") == 0
    return result.exit_code, Recording.open(imitate.folder / "run")


def events(recording: Recording) -> dict[str, list[str]]:
    """What happened, by its kind."""
    told: dict[str, list[str]] = {}
    for _, one in recording.messages("/events"):
        told.setdefault(one.name, []).append(messages.split_log(one)[0])
    return told


def test_the_table_has_a_row_for_every_fault_and_names_no_other():
    for fault in FAULTS:
        answer_to(fault)
    assert {name for one in ANSWERS for name in one.simulated} == set(FAULTS)
    assert {name for one in ANSWERS for name in one.emulated} == EMULATED


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_that_stays_ends_as_the_table_says(imitate, learned, fault):
    answer = answer_to(fault)
    # One target may happen to be held: what is wrong is seen away from it.
    code, recording = run(imitate, learned, fault, "null", trials=3)
    told = events(recording)
    assert code == answer.for_good
    assert ("device" in told) == (code == 3)
    if answer.event == "limited":
        assert answer.why in " ".join(told["limited"])
        *_, last = steps_told(recording)
        assert not np.any(last.step.sent)  # the arm rests
    elif answer.event == "hand":
        assert answer.why in " ".join(told["hand"])
    else:
        assert answer.event in ("device", "none")
    if answer.event == "none":
        assert "vision" not in " ".join(told.get("limited", []))


def test_a_run_that_was_over_before_its_fault_says_so(imitate, learned):
    words = ("robot=ideal", f"map={learned}", "fault=tag_lost", "fault.at=60")
    result = imitate("reach", *words)
    assert result.exit_code == 0
    assert "over before fault.at=60" in result.stderr


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_that_is_soon_over_ends_as_the_table_says(imitate, learned, fault):
    answer = answer_to(fault)
    code, recording = run(imitate, learned, fault, SOON_OVER)
    assert code == answer.soon_over
    assert ("device" in events(recording)) == (code == 3)


def test_a_device_that_fails_before_the_first_step_is_told_of_in_the_recording(imitate):
    words = ("robot=ideal", "fault=silence", "fault.at=0", "out=run")
    result = imitate("learn-map", *words)
    assert result.exit_code == 3
    assert "imitate inspect run" in result.stdout
    assert "imitate doctor" not in result.stderr  # nothing is wrong with this machine
    assert "does not answer" in events(Recording.open(imitate.folder / "run"))["device"][0]
    assert verify(imitate.folder / "run") == 0
    assert imitate("inspect", "run").exit_code == 0
    explained = imitate("explain", "run", "--at", "0")
    assert explained.exit_code == 2 and "holds no step" in explained.stderr


def test_a_device_that_is_not_there_is_followed_by_what_needs_none(imitate):
    words = ("robot=so101", "robot.arm.address=nowhere", "out=run")
    result = imitate("learn-map", *words)
    assert result.exit_code == 3
    assert len(result.stderr.splitlines()) == 1
    assert "imitate doctor robot=so101 robot.arm.address=nowhere;" in result.stderr
    assert "robot=so101_sim and imitate twin robot=so101 need no device" in result.stderr
    assert "run/  config.yaml log.txt" in result.stdout


def test_a_tag_that_is_soon_back_is_told_of(imitate, learned):
    _, recording = run(imitate, learned, "tag_lost", lasts="1.0")
    assert events(recording)["hand"] == ["no hand is seen any more", "a hand is seen again"]


@pytest.mark.parametrize(
    ("robot", "words", "told"),
    [
        ("so101_sim", ("fault=stuck_motor", "fault.joint=1"), "does not move"),
        pytest.param("kuka_sim", ("fault=camera_gone",), "no frame", marks=pytest.mark.slow),
        pytest.param("katana_sim", ("fault=stuck_encoder",), "not move", marks=pytest.mark.slow),
    ],
)
def test_a_fault_comes_to_any_body(imitate, robot, words, told):
    result = imitate("learn-map", f"robot={robot}", *words, "fault.at=0.2", "out=run")
    assert result.exit_code == 3
    assert told in result.stderr
    assert events(Recording.open(imitate.folder / "run"))["device"]
    assert verify(imitate.folder / "run") == 0


def test_a_joint_that_the_arm_lacks_is_bad_input(imitate):
    result = imitate("learn-map", "robot=ideal", "fault=hot_motor", "fault.joint=9")
    assert result.exit_code == 2
    assert "joints 1 to 5" in result.stderr


def test_a_film_cannot_be_spoilt(imitate):
    words = ("robot=ideal", "camera=video", "camera.path=none.mp4", "fault=camera_black")
    result = imitate("learn-map", *words)
    assert result.exit_code == 2


def test_what_was_sensed_while_something_went_wrong_cannot_be_otherwise(imitate, learned):
    run(imitate, learned, "two_tags", SOON_OVER)
    result = imitate("verify", "run", "--with", "fault=none")
    assert result.exit_code == 2
    assert "made the senses" in result.stderr
