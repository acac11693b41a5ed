"""Emulated Feetech STS3215 servos on one bus: packets of FF FF ID LENGTH CODE ... CHECKSUM."""

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from imitation.arrays import Array
from imitation.robots.faults import Faults
from imitation.robots.serving import LINE_FAULTS

SERVO_FAULTS = {
    "stuck_servo": "servo WHICH does not move",
    "stuck_encoder": "servo WHICH says for ever that it is where it was",
    "hot_servo": "servo WHICH is over its temperature",
    "overloaded_servo": "servo WHICH is overloaded",
}
FAULTS = LINE_FAULTS | SERVO_FAULTS
HEADER = b"\xff\xff"
PING, READ, WRITE, SYNC_READ, SYNC_WRITE = 1, 2, 3, 0x82, 0x83
EVERYONE = 0xFE
MODEL, STS3215 = 3, 777
FIRMWARE = (3, 10)
LOWEST, HIGHEST, HOTTEST, TORQUE_ON, GOAL, SPEED, TORQUE_LIMIT = 9, 11, 13, 40, 42, 46, 48
POSITION, VELOCITY, VOLTAGE, TEMPERATURE, STATUS = 56, 58, 62, 63, 65
HOT, OVERLOADED = 4, 32  # bits of the status
TURN = 4096  # steps
STEP = 2 * np.pi / TURN  # [rad]
UNLIMITED = 3073.0  # speed when none is asked for: 45 rpm [steps/s]


class EmulatedServo:
    """One servo: its control table, and where it is."""

    def __init__(self) -> None:
        self.table = bytearray(128)
        self.position = TURN / 2  # [steps]
        self.table[:2] = FIRMWARE
        for address, value in ((MODEL, STS3215), (LOWEST, 0), (HIGHEST, TURN - 1), (GOAL, 2048)):
            self.put(address, value)
        self.put(TORQUE_LIMIT, 1000)
        self.table[HOTTEST], self.table[TEMPERATURE], self.table[VOLTAGE] = 70, 30, 121

    def put(self, address: int, value: int) -> None:
        """Set a register of two bytes; a negative one has its sign in the highest bit."""
        self.table[address : address + 2] = (abs(value) | (0x8000 if value < 0 else 0)).to_bytes(
            2, "little"
        )

    def get(self, address: int) -> int:
        """A register of two bytes."""
        return int.from_bytes(self.table[address : address + 2], "little")

    def go_on(self, seconds: float, stuck: bool, says_so: bool) -> None:
        """Move towards the goal for so long, unless `stuck`, and tell it when it `says_so`."""
        before = self.position
        if self.table[TORQUE_ON] and not stuck:
            goal = min(max(self.get(GOAL), self.get(LOWEST)), self.get(HIGHEST))
            most = (self.get(SPEED) or UNLIMITED) * seconds
            self.position += min(max(goal - before, -most), most)
        if says_so:
            self.put(POSITION, round(self.position))
        self.put(VELOCITY, round((self.position - before) / seconds) if seconds and says_so else 0)


@dataclass
class ServoBusEmulator:
    """Servos at the other end of a line.

    Args:
        ids: Of the servos.
        faults: What goes wrong.
        speed: How many times faster than real servos they move.
        clock: Seconds that pass.
    """

    ids: Sequence[int] = (1, 2, 3, 4, 5, 6)
    faults: Faults = field(default_factory=Faults)
    speed: float = 1.0
    clock: Callable[[], float] = time.monotonic
    sessions: int = 0  # how often somebody began to talk to them
    _waiting: bytes = b""
    _began: float | None = None
    _now: float = 0.0

    def __post_init__(self) -> None:
        self.servos = {one: EmulatedServo() for one in self.ids}

    def pass_time(self) -> float:
        """Time since the first byte [s]; servos have moved until now."""
        if self._began is None:
            return 0.0
        now = (self.clock() - self._began) * self.speed
        for number, servo in self.servos.items():
            stuck, mute, hot, over = (self._has(name, number, now) for name in SERVO_FAULTS)
            servo.go_on(now - self._now, stuck, says_so=not mute)
            servo.table[TEMPERATURE] = 80 if hot else 30
            servo.table[STATUS] = HOT * hot | OVERLOADED * over
        self._now = now
        return now

    def posture(self) -> Array:
        """Where all servos but the jaw's are (n,) [rad]."""
        steps = [self.servos[one].position for one in self.ids[:-1]]
        return (np.array(steps) - TURN / 2) * STEP

    def opening(self) -> float:
        """Of the jaw, the last servo's; the simulated world's stays closed."""
        return 0.0

    def feel(self, proximity: float, touching: bool) -> None:
        """Nothing: such a jaw has no sensors."""

    def heard(self, data: bytes) -> Iterator[bytes]:
        """Replies to the packets that are complete by now."""
        if self._began is None:
            self._began = self.clock()
        self._waiting += data
        while (start := self._waiting.find(HEADER)) >= 0:
            packet = self._waiting[start:]
            if len(packet) < 4 or len(packet) < 4 + packet[3]:
                return
            whole, self._waiting = packet[: 4 + packet[3]], packet[4 + packet[3] :]
            if checksum(whole[2:-1]) == whole[-1]:
                self.pass_time()
                yield from self._obey(whole[2], whole[4], whole[5:-1])

    def _obey(self, number: int, code: int, rest: bytes) -> Iterator[bytes]:
        self.sessions += code in (READ, SYNC_READ) and rest[0] == MODEL  # what drivers ask first
        if code == SYNC_READ:
            for one in rest[2:]:
                if one in self.servos:
                    yield self._status(one, self._read(one, rest[0], rest[1]))
        elif code == SYNC_WRITE:
            size = rest[1] + 1
            for start in range(2, len(rest), size):
                self._write(rest[start], rest[0], rest[start + 1 : start + size])
        elif number in self.servos:
            if code == WRITE:
                self._write(number, rest[0], rest[1:])
            yield self._status(number, self._read(number, *rest[:2]) if code == READ else b"")

    def _read(self, number: int, address: int, count: int) -> bytes:
        return bytes(self.servos[number].table[address : address + count])

    def _write(self, number: int, address: int, data: bytes) -> None:
        if number in self.servos:
            self.servos[number].table[address : address + len(data)] = data

    def _status(self, number: int, data: bytes) -> bytes:
        body = bytes((number, len(data) + 2, self.servos[number].table[STATUS])) + data
        return HEADER + body + bytes((checksum(body),))

    def _has(self, fault: str, number: int, now: float) -> bool:
        found = self.faults.at(now, fault)
        return found is not None and found.which in (0, number)


def checksum(body: bytes) -> int:
    """What a packet ends with."""
    return ~sum(body) & 0xFF
