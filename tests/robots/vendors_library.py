"""Speaks to a Katana as the vendor's library does (facts/katana.md, 2.4), over a real line.

It is as strict: a reply that does not come whole, in one piece and at once is an error.
"""

import socket
import struct
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from emulated import katana_device, served

from imitation.robots.katana.frames import ASK_FOR_ERROR, crc, request_frame
from imitation.robots.katana.models import MODELS
from imitation.robots.serial_line import SerialLine

# Payload bytes that it insists on in the reply to each command.
REPLIES = dict(zip("BXYZCDEVNGHAST", (3, 181, 84, 1, 3, 8, 18, 13, 13, 2, 3, 2, 6, 2), strict=True))
MOTORS, JOINTS = range(1, 7), range(1, 6)
TOLERANCE = 100  # [encoders]
PATIENCE = 20.0  # for any movement [s]
SPEED = 50.0  # times faster than a real arm


class VendorsLibrary:
    """The calls of the vendor's library, each with the requests that it really sends."""

    def __init__(self, model: str, exchange: Callable[[bytes, int], bytes]) -> None:
        self.model, self._exchange = MODELS[model], exchange

    def ask(self, payload: bytes) -> bytes:
        length = 2 if payload[0] == 0xC7 else REPLIES[chr(payload[0])]
        told = self._exchange(request_frame(payload), length + 2)
        assert len(told) == length + 2, (payload.hex(), told.hex())
        assert crc(told[:-2]).to_bytes(2, "big") == told[-2:]
        assert told[0] == payload[0] | 0x20
        assert payload[:1] not in (b"D", b"V", b"E") or told[1]
        assert payload[:1] != b"C" or payload[1] == 0 or told[1]
        return told[:-2]

    def control(self, motor: int, flag: int, position: int = 0) -> None:
        self.ask(struct.pack(">cBBh", b"C", motor, flag, position))

    def motor(self, number: int) -> tuple[int, int, int]:
        """Status, position and velocity."""
        _, _, status, position, velocity, _ = struct.unpack(">BBBhhB", self.ask(b"D%c" % number))
        return status, position, velocity

    def positions(self) -> tuple[int, ...]:
        return struct.unpack(">x6h", self.ask(b"N\x03\x00"))

    def connect(self) -> None:
        for number in MOTORS:
            self.ask(b"V%c\x20" % number)
        if self.model.name == "450":
            self.control(0, 32)
        version = self.ask(b"B")[1]
        assert version >= 3 if self.model.serial else version <= 3  # else it ends the program

    def hello(self) -> None:
        for request in (b"B", b"Z", b"Y", b"Y", b"X"):
            self.ask(request)

    def unblock(self, flag: int = 8) -> None:
        """Also freezing (8) and switching off (0)."""
        for number in MOTORS:
            _, position, _ = self.motor(number)
            self.control(number, flag, position)

    def limit_crashes(self, on: bool) -> None:
        self.ask(b"B")
        self.ask(b"A\x00%c" % on)

    def start_as_ros_does(self) -> None:
        self.unblock()
        self.limit_crashes(True)
        _, position, _ = self.motor(2)
        self.move({2: position + 100})
        self.move({2: position})

    def move(self, targets: dict[int, int]) -> None:
        for number, target in targets.items():
            self.control(number, 24, target)
        for number, target in targets.items():
            self.until(lambda n=number, t=target: abs(self.motor(n)[1] - t) < TOLERANCE)

    def move_all(self, targets: tuple[int, ...]) -> None:
        for number, target in zip(MOTORS, targets, strict=True):
            self.control(number, 24, target)

        def near() -> bool:
            far = max(abs(a - b) for a, b in zip(self.positions(), targets, strict=True))
            assert 40 not in self.ask(b"N\x01\x00")[1:7]
            return far < TOLERANCE

        self.until(near)

    def calibrate(self) -> None:
        if self.model.calibrates_itself:
            self.ask(bytes.fromhex("4300047d00"))
            self.until(lambda: self.motor(1)[0] != 4)
            return
        for number in MOTORS:
            self.control(number + 128, 24, 0)
        for number in (2, 3, 4, 5, 6, 1):
            self._search_stop(number, -1 if number in (2, 3) else 1)

    def _search_stop(self, number: int, sense: int) -> None:
        self._set_up(number, b"\x19\x19")
        self.control(number + 128, 8, -31000 * sense)
        self.control(number, 24, 32000 * sense)
        velocities = [1, self.motor(number)[2]]
        while sum(velocities[-2:]):
            time.sleep(0.3 / SPEED)
            velocities.append(self.motor(number)[2])
        self.control(number + 128, 8, 0)
        self._set_up(number, b"\x64\x64")
        self.control(number + 128, 24, 31000 * sense)
        self.move({number: 30000 * sense})

    def _set_up(self, number: int, speed: bytes) -> None:
        for setting in (b"\2\x7f\x7f", b"\1\7\2d", b"\5\3 ", b"\6\3 ", b"\4\1", b"\3" + speed):
            self.ask((b"S%c" % number + setting).ljust(6, b"\0"))

    def spline(self, targets: dict[int, int], ticks: int) -> None:
        """G for each motor, then start; waits as `waitFor` does."""
        here = self.positions()
        for number, target in targets.items():
            values = (target, ticks, *_cubic(here[number - 1], target, ticks))
            self.ask(struct.pack(">cBhHhhhh", b"G", number, *values))
        self.ask(b"\xc7\x01\x01")
        self._wait_for_splines(targets)

    def splines_of_all(self, targets: tuple[int, ...], ticks: int) -> None:
        """H: five that wait and one that starts them, as moveRobotTo does."""
        here = self.positions()
        halfway = [(a + b) // 2 for a, b in zip(here, targets, strict=True)]
        for start, end, more in ((here, halfway, 2), (halfway, targets, 1)):
            body = b"".join(
                struct.pack(">Hhhhhh", ticks, b, *_cubic(a, b, ticks))
                for a, b in zip(start, end, strict=True)
            )
            self.ask(b"H" + body + bytes((more, 1)))
        self._wait_for_splines(dict(zip(JOINTS, targets, strict=False)))
        off = [abs(a - b) for a, b in zip(self.positions(), targets, strict=True)]
        assert max(off) <= 1

    def _wait_for_splines(self, targets: dict[int, int]) -> None:
        missing = set(targets)

        def over() -> bool:
            statuses = self.ask(b"N\x01\x00")[1:7]
            if self.model.serial:  # a 300 never says that it has arrived
                here = self.positions()
                return all(abs(here[n - 1] - t) < TOLERANCE for n, t in targets.items())
            missing.difference_update(n for n in targets if statuses[n - 1] == 88)
            return not missing

        self.until(over, pause=0.0)

    def error_report(self) -> bytes:
        """What comes for a motor that there is not, on a 400 or 450."""
        flag = self._exchange(request_frame(b"D\x09"), 10)
        assert flag == bytes.fromhex("c05000")
        return self._exchange(ASK_FOR_ERROR, 57)

    def sensors(self) -> bytes:
        return self.ask(b"E\x0f")[2:]

    def limits(self) -> None:
        for number in MOTORS:
            for setting in (b"\4\2", b"\3\x1e\x1e"):
                self.ask((b"S%c" % number + setting).ljust(6, b"\0"))
            for setting in (b"\5", b"\6") if self.model.serial else (b"\5", b"\7", b"\xf4"):
                self.ask((b"S%c" % number + setting).ljust(6, b"\0"))

    def digital(self) -> None:
        for port in (b"r", b"w\1", b"w\0", b"lr", b"lg", b"l\0"):
            self.ask((b"T" + port).ljust(5, b"\0"))

    def until(self, over: Callable[[], bool], pause: float = 0.2) -> None:
        """Ask again and again until it is so."""
        until = time.monotonic() + PATIENCE
        while not over():
            assert time.monotonic() < until
            time.sleep(pause / SPEED)


def _cubic(start: int, target: int, ticks: int) -> tuple[int, int, int, int]:
    """Coefficients p0 to p3 of a segment that begins and ends at rest."""
    way = target - start
    return start, 0, round(3 * way / ticks**2 * 1024), round(-2 * way / ticks**3 * 32768)


@contextmanager
def at_work(model: str, folder: Path) -> Iterator[VendorsLibrary]:
    """The vendor's library at the other end of a line to an emulated arm."""
    device = katana_device(model, speed=SPEED)
    if MODELS[model].serial:
        with served(device, folder / "port") as where:
            line = SerialLine(where, 57600, 1.0)

            def over_serial(request: bytes, length: int) -> bytes:
                line.drain()
                line.send(request)
                return line.receive(length, 0.3)

            yield VendorsLibrary(model, over_serial)
            line.close()
        return
    with served(device) as where:
        host, _, port = where.partition(":")
        with socket.create_connection((host, int(port)), 5) as client:

            def over_tcp(request: bytes, length: int) -> bytes:
                client.sendall(request)
                return client.recv(4096)  # once: what comes in two pieces is an error

            yield VendorsLibrary(model, over_tcp)
