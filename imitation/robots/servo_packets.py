"""Packets on a bus of servos, as the servos know them: Feetech STS, and Dynamixel protocol 2.0."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

PING, READ, WRITE, SYNC_READ, SYNC_WRITE, STATUS = 1, 2, 3, 0x82, 0x83, 0x55
EVERYONE = 0xFE
ALERT = 0x80  # in the error of a Dynamixel: its register of trouble tells more
STUFFED = b"\xff\xff\xfd"  # in what a packet carries it would be taken for another's header
LONGEST = 1024  # what claims to be longer is no packet


@dataclass(frozen=True)
class Request:
    """What a servo, or all of them, are asked."""

    number: int  # of the servo
    code: int  # the instruction
    rest: bytes  # its parameters


class Packets(ABC):
    """How requests and replies are written."""

    header: bytes
    width: int  # bytes of an address, and of a count
    shortest: int  # request: its instruction, and nothing else [bytes]
    room: int  # for registers in a reply [bytes]

    def requests(self, waiting: bytes) -> tuple[list[Request], bytes]:
        """The requests that are complete in what has come, and what is left of it."""
        found = []
        while (start := waiting.find(self.header)) >= 0:
            waiting = waiting[start:]
            end = self.end(waiting)
            if end > LONGEST:
                waiting = waiting[1:]
            elif end > len(waiting):
                break
            else:
                packet, waiting = waiting[:end], waiting[end:]
                sound = len(packet) >= self.shortest and self.sound(packet)
                found += [self.request(packet)] if sound else []
        return found, waiting

    @abstractmethod
    def end(self, packet: bytes) -> int:
        """How long the packet that begins here is."""

    @abstractmethod
    def sound(self, packet: bytes) -> bool:
        """Whether it is undamaged."""

    @abstractmethod
    def request(self, packet: bytes) -> Request:
        """What it asks."""

    @abstractmethod
    def status(self, number: int, trouble: int, error: int, data: bytes) -> bytes:
        """The reply of servo `number`."""


class FeetechPackets(Packets):
    """FF FF ID LENGTH CODE ... CHECKSUM."""

    header, width, shortest, room = b"\xff\xff", 1, 6, 253

    def end(self, packet: bytes) -> int:
        """Four bytes come before what its length counts."""
        return 4 + packet[3] if len(packet) > 3 else 5

    def sound(self, packet: bytes) -> bool:
        """Its checksum is right."""
        return checksum(packet[2:-1]) == packet[-1]

    def request(self, packet: bytes) -> Request:
        """What it asks."""
        return Request(packet[2], packet[4], packet[5:-1])

    def status(self, number: int, trouble: int, error: int, data: bytes) -> bytes:
        """The error tells of trouble alone."""
        body = bytes((number, len(data) + 2, trouble)) + data
        return self.header + body + bytes((checksum(body),))


class DynamixelPackets(Packets):
    """FF FF FD 00 ID LENGTH LENGTH CODE ... CRC CRC."""

    header, width, shortest, room = b"\xff\xff\xfd\x00", 2, 10, LONGEST

    def end(self, packet: bytes) -> int:
        """Seven bytes come before what its length counts."""
        return 7 + int.from_bytes(packet[5:7], "little") if len(packet) > 6 else 8

    def sound(self, packet: bytes) -> bool:
        """Its CRC is right."""
        return crc(packet[:-2]).to_bytes(2, "little") == packet[-2:]

    def request(self, packet: bytes) -> Request:
        """What it asks; bytes that were stuffed in are taken out."""
        carried = packet[7:-2].replace(STUFFED + b"\xfd", STUFFED)
        return Request(packet[4], carried[0], carried[1:])

    def status(self, number: int, trouble: int, error: int, data: bytes) -> bytes:
        """The error tells what was wrong with the request, and whether there is trouble."""
        told = bytes((STATUS, (ALERT if trouble else 0) | error)) + data
        carried = told.replace(STUFFED, STUFFED + b"\xfd")
        length = (len(carried) + 2).to_bytes(2, "little")
        packet = self.header + bytes((number,)) + length + carried
        return packet + crc(packet).to_bytes(2, "little")


def checksum(body: bytes) -> int:
    """What a packet of a Feetech servo ends with."""
    return ~sum(body) & 0xFF


def crc(data: bytes) -> int:
    """CRC-16 of a Dynamixel packet: polynomial 0x8005 from 0, highest bit first."""
    value = 0
    for byte in data:
        value ^= byte << 8
        for _ in range(8):
            value = ((value << 1) ^ 0x8005 if value & 0x8000 else value << 1) & 0xFFFF
    return value
