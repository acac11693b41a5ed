"""Packets of bus servos, against examples that their makers published."""

import pytest

from imitation.robots.servo_bus_emulator import ServoBusEmulator
from imitation.robots.servo_packets import (
    DynamixelPackets,
    FeetechPackets,
    Request,
    checksum,
    crc,
)

PING = bytes.fromhex("fffffd00010300 01 194e")
STUFFED = bytes.fromhex("03 7400 ffff fdfd 00")  # a goal of 0x00fdffff


@pytest.mark.parametrize("packet", [PING, bytes.fromhex("fffffd0001080055 00 a6000000 8cc0")])
def test_the_crc_is_that_of_published_packets(packet):
    assert crc(packet[:-2]).to_bytes(2, "little") == packet[-2:]


def test_a_reply_is_the_published_one():
    reply = DynamixelPackets().status(1, 0, 0, bytes.fromhex("060426"))
    assert reply == bytes.fromhex("fffffd00010700 55 00 060426 655d")


def test_the_checksum_is_that_of_a_published_packet():
    assert checksum(bytes.fromhex("010201")) == 0xFB


def test_requests_are_read_from_pieces_and_noise_and_damaged_ones_are_passed_over():
    packets = DynamixelPackets()
    assert packets.requests(PING[:6]) == ([], PING[:6])
    damaged = PING[:-1] + b"\0"
    found, rest = packets.requests(b"noise" + damaged + PING + PING[:3])
    assert found == [Request(1, 1, b"")]
    assert rest == PING[:3]


def test_what_claims_to_be_endless_keeps_nobody_waiting():
    endless = bytes.fromhex("fffffd0001ffff")
    assert DynamixelPackets().requests(endless + PING)[0] == [Request(1, 1, b"")]


def test_bytes_stuffed_into_a_packet_are_taken_out_and_put_in():
    packets, body = DynamixelPackets(), bytes.fromhex("fffffd00010a00") + STUFFED
    found, _ = packets.requests(body + crc(body).to_bytes(2, "little"))
    assert found == [Request(1, 3, bytes.fromhex("7400 ffff fd 00"))]
    assert bytes.fromhex("ffff fdfd") in packets.status(1, 0, 0, bytes.fromhex("fffffd00"))


def test_trouble_is_told_in_every_reply():
    assert DynamixelPackets().status(1, 32, 7, b"")[8] == 0x87
    assert FeetechPackets().status(1, 32, 7, b"")[4] == 32


@pytest.mark.parametrize(
    "asked",
    [
        "ff ff 06 09 82 01 ff 00 38 27 01 04 0a",  # more registers than a reply has room for
        "ff ff 01 04 02 00 ff f9",
        "ff ff ff 00",  # no instruction, but a right checksum
    ],
)
def test_what_no_servo_could_answer_is_met_with_silence(asked):
    servos = ServoBusEmulator()
    assert not list(servos.heard(bytes.fromhex(asked)))
    ping = bytes.fromhex("ffff010201fb")
    assert list(servos.heard(ping)) == [bytes.fromhex("ffff010200fc")]


def test_a_packet_without_an_instruction_is_no_request():
    empty = bytes.fromhex("fffffd00010200")
    assert DynamixelPackets().requests(empty + crc(empty).to_bytes(2, "little")) == ([], b"")
