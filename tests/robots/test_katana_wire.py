"""The Katana's wire protocol: frames, the recorded dialogues, and what goes wrong on a line."""

import pytest
from katana_dialogues import ASK_FOR_ERROR, ERROR_FLAG, NAMES, Turn, dialogue

from imitation.device import DeviceError
from imitation.robots.faults import Faults, read_fault
from imitation.robots.katana import commands
from imitation.robots.katana.connection import Connection, RefusedError
from imitation.robots.katana.emulated_arm import EmulatedArm
from imitation.robots.katana.emulator import FAULTS, KatanaEmulator
from imitation.robots.katana.frames import BadReplyError, crc, reply_payload, request_frame, sealed
from imitation.robots.katana.models import MODELS

# Dialogues in which something went wrong: what goes wrong in the emulator, one second a request.
WENT_WRONG = {
    "400_tcp_error_frame_E": "error_flag@7-8",
    "400_tcp_crc_retry": "wrong_crc@7-8",
    "300_serial_error_frame_E": "silence@7-8",
    "300_serial_silent_retry": "silence@7-8",
}
ACKNOWLEDGED = b"BCSGHAVXZT\xc7"  # what their replies hold does not depend on where the arm is


@pytest.mark.parametrize(
    ("data", "value"),
    [
        (b"123456789", 0xBB3D),
        (b"", 0),
        (b"B", 0x3180),
        (b"X", 0xFA01),
        (bytes.fromhex("4e0100"), 0x8761),
        (bytes.fromhex("4301187530"), 0xB0E2),
        (b"\xc0", 0x5000),
    ],
)
def test_the_crc_is_crc_16_arc(data, value):
    assert crc(data) == value


class Recorded:
    """The arm's side of a recorded dialogue, as a line."""

    name = "a recorded dialogue"

    def __init__(self, turns: list[Turn]) -> None:
        self.turns, self.coming = list(turns), b""

    def send(self, data: bytes) -> None:
        turn = self.turns.pop(0)
        assert data == turn.request
        self.coming = turn.reply

    def receive(self, count: int, timeout: float) -> bytes:
        now, self.coming = self.coming[:count], self.coming[count:]
        return now

    def drain(self) -> None:
        self.coming = b""

    def close(self) -> None:
        pass


@pytest.mark.parametrize("name", NAMES)
def test_the_driver_accepts_every_answer_that_was_recorded(name):
    line = Recorded(dialogue(name))
    connection = Connection(line, tells_errors="tcp" in name, timeout=0.0, tries=4)
    while line.turns:
        payload = line.turns[0].request[3:-2]
        refused = line.turns[0].reply[1:2] == b"\0" and payload[0] in b"DVE"
        if refused or (line.turns[0].reply == ERROR_FLAG and "tcp" in name):
            with pytest.raises(RefusedError):
                connection.ask(payload)
        else:
            connection.ask(payload)


def test_what_a_refusal_tells_is_understood():
    turns = dialogue("400_tcp_error_frame_E")[-2:]
    connection = Connection(Recorded(turns), tells_errors=True, timeout=0.0, tries=4)
    with pytest.raises(RefusedError, match=r"E of motor 1: collision .*StopperThread") as told:
        connection.ask(commands.SENSORS)
    assert (told.value.code, told.value.axis) == (-10, 1)


@pytest.mark.parametrize("name", [name for name in NAMES if "connect" in name])
def test_recorded_answers_mean_what_the_vendor_says(name):
    said = {turn.request[3:-2]: turn for turn in dialogue(name)}
    payload = {request: reply_payload(request, turn.reply) for request, turn in said.items()}
    at = (30000, -30000, -30000, 30000, 30000, 30000)
    assert commands.positions_of(payload[commands.ALL_POSITIONS]) == at
    assert commands.statuses_of(payload[commands.ALL_STATUS]) == (8,) * 6
    second = commands.motor_of(payload[commands.read_motor(2)])
    assert second == commands.MotorReading(2, 8, -30000, 0, 0)
    version = (4, 30) if name.startswith("300") else (1, 1)
    assert commands.version_of(payload[commands.VERSION]) == version
    assert commands.identity_of(payload[commands.IDENTITY]).startswith("Katana emulator")


class Clock:
    """Goes on by one second each time somebody speaks."""

    time = 0.0

    def __call__(self) -> float:
        return self.time


def wire(emulator: KatanaEmulator, data: bytes) -> list[bytes]:
    """What comes back over a perfect line; without time for the faults of lines."""
    return list(emulator.heard(data))


@pytest.mark.parametrize("name", NAMES)
def test_the_emulator_gives_an_answer_of_the_recorded_form_to_every_request(name):
    clock = Clock()
    model = MODELS[name.split("_")[0]]
    planned = [read_fault(WENT_WRONG[name], FAULTS)] if name in WENT_WRONG else []
    emulator = KatanaEmulator(EmulatedArm(model), Faults(planned), clock=clock)
    turns = dialogue(name)
    forms = {turn.request: len(turn.reply) for turn in turns if turn.reply != ERROR_FLAG}
    for turn in turns:
        told = wire(emulator, turn.request)
        clock.time += 1.0
        expected = turn.reply
        if name in WENT_WRONG and model.serial and expected in (b"", ERROR_FLAG):
            continue  # it is the line that says nothing
        assert [len(one) for one in told] == [len(expected) or forms[turn.request]]
        assert told[0] == sealed(told[0][:-2])
        if turn.request != ASK_FOR_ERROR and told[0] != ERROR_FLAG:
            assert told[0][:1] == (turn.request[3] | 0x20).to_bytes()
        if expected and turn.request[3] in ACKNOWLEDGED:
            assert told[0] == expected


def emulated(model: str, *faults: str) -> KatanaEmulator:
    planned = [read_fault(one, FAULTS) for one in faults]
    return KatanaEmulator(EmulatedArm(MODELS[model]), Faults(planned), clock=Clock())


def test_a_request_that_comes_in_pieces_is_answered_once():
    frame = request_frame(commands.ALL_POSITIONS)
    emulator = emulated("400")
    told = [reply for byte in frame for reply in wire(emulator, bytes((byte,)))]
    assert len(told) == 1


def test_noise_before_a_request_is_passed_over():
    assert len(wire(emulated("400"), b"\x00\x07\x01noise" + request_frame(b"Z"))) == 1


def test_a_400_flags_what_a_300_is_silent_about():
    damaged = request_frame(b"Z")[:-1] + b"\0"
    for nonsense in (damaged, request_frame(b"?")):
        assert wire(emulated("400"), nonsense) == [ERROR_FLAG]
        assert wire(emulated("300"), nonsense) == []


def test_a_300_has_no_spline_for_all_motors():
    segments = commands.as_segments([0] * 6, [0] * 6, 10)
    frame = request_frame(commands.all_segments(segments, more=False, exact=1))
    assert wire(emulated("300"), frame) == []
    assert wire(emulated("400"), frame) == [sealed(b"h\x01\x01")]


def test_a_fault_that_does_not_exist_is_refused_with_those_that_do():
    with pytest.raises(ValueError, match=r"no fault fire; .*wrong_crc"):
        read_fault("fire", FAULTS)


@pytest.mark.parametrize("damage", [b"", b"z", b"z\xe3\x00", b"y\xe3\x81"])
def test_a_damaged_reply_is_none(damage):
    with pytest.raises(BadReplyError):
        reply_payload(b"Z", damage)


def test_an_arm_that_stays_silent_is_given_up_with_what_to_check():
    line = Recorded([Turn(request_frame(b"Z"), b"")] * 4)
    connection = Connection(line, tells_errors=True, timeout=0.0, tries=4)
    with pytest.raises(DeviceError, match=r"asked Z 4 times in vain: 0 bytes .*check its power"):
        connection.ask(b"Z")
