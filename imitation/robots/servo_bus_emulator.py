"""An emulated bus of servos, Feetech or Dynamixel, at the other end of a line."""

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from imitation.arrays import Array
from imitation.robots.emulated_servos import (
    COOL,
    HOT,
    MODEL,
    OVERLOADED,
    STATUS,
    STS3215,
    TEMPERATURE,
    TOO_HOT,
    TURN,
    EmulatedServo,
    Make,
)
from imitation.robots.faults import Faults, Kind
from imitation.robots.serving import LINE_FAULTS
from imitation.robots.servo_packets import (
    EVERYONE,
    PING,
    READ,
    SYNC_READ,
    SYNC_WRITE,
    WRITE,
    Request,
)

IDS = (1, 2, 3, 4, 5, 6)
SERVO_FAULTS = {
    "stuck_servo": Kind("servo WHICH does not move", parts=len(IDS)),
    "stuck_encoder": Kind("servo WHICH says for ever that it is where it was", parts=len(IDS)),
    "hot_servo": Kind("servo WHICH is over its temperature", parts=len(IDS)),
    "overloaded_servo": Kind("servo WHICH is overloaded", parts=len(IDS)),
}
FAULTS = LINE_FAULTS | SERVO_FAULTS
STEP = 2 * np.pi / TURN  # [rad]


@dataclass
class ServoBusEmulator:
    """All servos of an arm; the last one is its jaw's.

    Args:
        ids: Of the servos.
        make: What they are.
        faults: What goes wrong.
        speed: How many times faster than real servos they move.
        clock: Seconds that pass.
    """

    ids: Sequence[int] = IDS
    make: Make = STS3215
    faults: Faults = field(default_factory=Faults)
    speed: float = 1.0
    clock: Callable[[], float] = time.monotonic
    sessions: int = 0  # how often somebody began to talk to them
    _waiting: bytes = b""
    _began: float | None = None
    _now: float = 0.0

    def __post_init__(self) -> None:
        self.servos = {one: EmulatedServo(self.make) for one in self.ids}

    def pass_time(self) -> float:
        """Time since the first byte [s]; servos have moved until now."""
        if self._began is None:
            return 0.0
        now = (self.clock() - self._began) * self.speed
        for number, servo in self.servos.items():
            stuck, mute, hot, over = (self._has(name, number, now) for name in SERVO_FAULTS)
            servo.go_on(now - self._now, stuck, says_so=not mute)
            servo.put(TEMPERATURE, TOO_HOT if hot else COOL)
            servo.put(STATUS, HOT * hot | OVERLOADED * over)
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
        asked, self._waiting = self.make.packets.requests(self._waiting + data)
        for request in asked:
            self.pass_time()
            yield from self._obey(request)

    def _obey(self, asked: Request) -> Iterator[bytes]:
        width = self.make.packets.width
        address, rest = _number(asked.rest[:width]), asked.rest[width:]
        count, each = _number(rest[:width]), rest[width:]
        if asked.code in (READ, SYNC_READ) and count > self.make.packets.room:
            return
        model, _ = self.make.cells[MODEL]
        # Every driver asks first for the model.
        self.sessions += asked.code in (READ, SYNC_READ) and address == model
        if asked.code == SYNC_READ:
            for one in each:
                if one in self.servos:
                    yield self._status(one, self._read(one, address, count))
        elif asked.code == SYNC_WRITE:
            for start in range(0, len(each), count + 1):
                if each[start] in self.servos:
                    self.servos[each[start]].write(address, each[start + 1 : start + count + 1])
        elif asked.number in self.servos or asked.number == EVERYONE:
            yield from self._answers(asked, address, count, rest)

    def _answers(self, asked: Request, address: int, count: int, data: bytes) -> Iterator[bytes]:
        """To a request of one servo; when all are asked, only a ping is answered."""
        everyone = asked.number == EVERYONE
        for number in self.ids if everyone else [asked.number]:
            error = self.servos[number].write(address, data) if asked.code == WRITE else 0
            told = self._read(number, address, count) if asked.code == READ else b""
            if asked.code == PING and self.make.packets.width == 2:
                told = bytes(self.servos[number].table[:2]) + self._read(number, 6, 1)
            if not everyone or asked.code == PING:
                yield self._status(number, told, error)

    def _read(self, number: int, address: int, count: int) -> bytes:
        return bytes(self.servos[number].table[address : address + count])

    def _status(self, number: int, data: bytes, error: int = 0) -> bytes:
        trouble = self.servos[number].get(STATUS)
        return self.make.packets.status(number, trouble, error, data)

    def _has(self, fault: str, number: int, now: float) -> bool:
        found = self.faults.at(now, fault)
        return found is not None and found.which in (0, number)


def _number(data: bytes) -> int:
    return int.from_bytes(data, "little")
