"""An emulated SSC-32 servo controller: lines of ASCII, ended by CR (facts/katana.md, 4)."""

import re
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from imitation.robots.faults import Faults, Kind
from imitation.robots.serving import LINE_FAULTS

FAULTS = {name: LINE_FAULTS[name] for name in ("silence", "cut", "late")} | {
    "reset": Kind("at START the board forgets its servos (weak supply)"),
}
CR, ESC = 0x0D, 0x1B
IGNORED = b" \t\n"
SHORTEST, LONGEST = 500, 2500  # pulses [us]
SERVO = re.compile(r"#(\d+)P(\d+)(?:S(\d+))?")
MOVE = re.compile(r"(?P<servos>(?:#\d+P\d+(?:S\d+)?)+)(?:T(?P<time>\d+))?")
QUERY = re.compile(r"QP(\d+)")


@dataclass
class Servo:
    """One channel: from where to where, and when."""

    pulse: float = 0.0  # wanted [us]; 0: no pulses, so nobody knows where the servo is
    start: float = 0.0
    began: float = 0.0  # [s]
    lasts: float = 0.0  # [s]

    def at(self, now: float) -> float:
        """The pulse that is sent at `now` [s]."""
        if self.lasts <= 0 or now >= self.began + self.lasts:
            return self.pulse
        return self.start + (self.pulse - self.start) * (now - self.began) / self.lasts


@dataclass
class Ssc32Emulator:
    """A board at the other end of a line.

    Args:
        faults: What goes wrong.
        speed: How many times faster than a real board it moves.
        clock: Seconds that pass.
    """

    faults: Faults = field(default_factory=Faults)
    speed: float = 1.0
    clock: Callable[[], float] = time.monotonic
    servos: dict[int, Servo] = field(default_factory=dict)
    _line: bytes = b""
    _began: float | None = None
    _was_reset: bool = False

    def pass_time(self) -> float:
        """Time since the first byte [s]; servos are where their pulses say."""
        if self._began is None:
            return 0.0
        now = (self.clock() - self._began) * self.speed
        if self.faults.at(now, "reset") and not self._was_reset:
            self.servos.clear()
            self._was_reset = True
        return now

    def heard(self, data: bytes) -> Iterator[bytes]:
        """Replies to the lines that are complete by now."""
        if self._began is None:
            self._began = self.clock()
        for byte in data:
            if byte == ESC:
                self._line = b""
            elif byte == CR:
                line, self._line = self._line, b""
                if reply := self._obey(line.decode("ascii", "replace").upper()):
                    yield reply
            elif byte not in IGNORED:
                self._line += bytes((byte,))

    def pulses(self) -> dict[int, float]:
        """The pulse of each channel that has one [us]."""
        now = self.pass_time()
        return {channel: servo.at(now) for channel, servo in self.servos.items() if servo.pulse}

    def _obey(self, line: str) -> bytes:
        """What a line is answered with; nothing that is not understood says so."""
        now = self.pass_time()
        if line == "VER":
            return b"SSC32-V2.50USB\r"
        if line == "Q":
            moving = any(now < servo.began + servo.lasts for servo in self.servos.values())
            return b"+" if moving else b"."
        if asked := QUERY.findall(line):
            return bytes(
                round(self.servos.get(int(one), Servo()).at(now) / 10) & 0xFF for one in asked
            )
        if stopped := re.fullmatch(r"STOP(\d+)", line):
            servo = self.servos.setdefault(int(stopped[1]), Servo())
            servo.pulse = servo.start = servo.at(now)
        elif move := MOVE.fullmatch(line):
            self._move(move["servos"], float(move["time"] or 0) / 1000, now)
        return b""

    def _move(self, servos: str, least: float, now: float) -> None:
        wanted = [
            (int(channel), clamped(int(pulse)), int(speed or 0))
            for channel, pulse, speed in SERVO.findall(servos)
            if int(channel) < 32
        ]
        known = [
            (self.servos[channel].at(now), pulse, speed)
            for channel, pulse, speed in wanted
            if channel in self.servos
        ]
        lasts = max(
            [least, *(abs(pulse - at) / speed for at, pulse, speed in known if at and speed)]
        )
        for channel, pulse, _ in wanted:
            before = self.servos.get(channel, Servo()).at(now)
            # The first move after power-up jumps: the board does not know where the servo is.
            self.servos[channel] = Servo(pulse, before, now, lasts if before and pulse else 0.0)


def clamped(pulse: int) -> float:
    """The pulse the board makes of the one it was given [us]."""
    return float(min(max(pulse, SHORTEST), LONGEST)) if pulse else 0.0
