"""An emulated Katana: answers every request as a 300, 400 or 450 does (facts/katana.md, 2.8)."""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from threading import Lock

import numpy as np

from imitation.arrays import Array
from imitation.robots.faults import Fault, Faults, Kind
from imitation.robots.katana.answers import Answers
from imitation.robots.katana.commands import motor_version
from imitation.robots.katana.emulated_arm import EmulatedArm, RefusalError
from imitation.robots.katana.frames import (
    ADDRESS,
    ASK_FOR_ERROR,
    ERROR_FLAG,
    ERROR_REPORT,
    ERROR_TEXT,
    sealed,
)
from imitation.robots.katana.models import MOTORS
from imitation.robots.serving import LINE_FAULTS

FAULTS = LINE_FAULTS | {
    "error_flag": Kind("each request is refused (400 and 450)"),
    "crashed_motor": Kind(
        "motor WHICH (1) collides: status 40, it moves no more until unblocked", parts=MOTORS
    ),
    "stuck_motor": Kind("motor WHICH (1) does not move and does not say so", parts=MOTORS),
    "stuck_encoder": Kind("the encoder of motor WHICH (1) says the same for ever", parts=MOTORS),
    "stuck_sensor": Kind("the gripper's sensors say the same for ever"),
    "uncalibrated": Kind("the arm was just switched on"),
}
FIRST = motor_version(1)  # what every driver asks first
STALE = 0.5  # a frame that is not complete by then never will be [s]
HEADER = 3


@dataclass
class KatanaEmulator:
    """A Katana at the other end of a line.

    Args:
        arm: The arm itself.
        faults: What goes wrong.
        speed: How many times faster than a real arm it moves.
        clock: Seconds that pass.
    """

    arm: EmulatedArm
    faults: Faults = field(default_factory=Faults)
    speed: float = 1.0
    clock: Callable[[], float] = time.monotonic
    sessions: int = 0  # how often somebody began to talk to it
    _buffer: bytes = b""
    _heard_at: float = 0.0
    _began: float | None = None
    _refused: RefusalError = field(default_factory=lambda: RefusalError(0, 0, "no error"))
    _asked: int = 0  # letter of the request before
    _one_at_a_time: Lock = field(default_factory=Lock)
    _crashed: list[Fault] = field(default_factory=list)  # each crash happens once

    def pass_time(self) -> float:
        """Let the motors go on until now; returns the time since the first request [s]."""
        if self._began is None:
            return 0.0
        with self._one_at_a_time:  # a twin's world asks too
            now = (self.clock() - self._began) * self.speed
            self.arm.advance_to(now)
            self._break(now)
        return now

    def posture(self) -> Array:
        """Where the joints are (5,) [rad]."""
        return self.arm.model.angles(np.array([one.position for one in self.arm.motors[:5]]))

    def opening(self) -> float:
        """Of the gripper, 0 closed .. 1 open."""
        return self.arm.model.opening(self.arm.motors[-1].counter)

    def feel(self, proximity: float, touching: bool) -> None:
        """What the gripper's sensors have before them, and whether both fingers touch it."""
        self.arm.sensors.distance, self.arm.sensors.pressed = proximity, touching

    def heard(self, data: bytes) -> Iterator[bytes]:
        """Replies to the requests that are complete by now."""
        now = self.clock()
        if self._began is None:
            self._began = now
            if self.faults.at(0.0, "uncalibrated"):
                self.arm.just_switched_on()
        if now - self._heard_at > STALE:
            self._buffer = b""
        self._heard_at, self._buffer = now, self._buffer + data
        while (request := self._next_request()) is not None:
            reply = self._reply(request)
            if reply is not None:
                yield reply

    def _next_request(self) -> bytes | None:
        """Payload and CRC of the next complete frame; the request for an error report as it is."""
        while self._buffer:
            if self._buffer.startswith(ASK_FOR_ERROR):
                self._buffer = self._buffer[len(ASK_FOR_ERROR) :]
                return ASK_FOR_ERROR
            if ASK_FOR_ERROR.startswith(self._buffer):
                return None
            header = bytes((1, ADDRESS))
            if self._buffer[:2] == header[: len(self._buffer[:2])]:
                return self._complete_frame()
            self._buffer = self._buffer[1:]  # noise
        return None

    def _complete_frame(self) -> bytes | None:
        if len(self._buffer) < HEADER:
            return None
        end = HEADER + self._buffer[2] + 2
        if len(self._buffer) < end:
            return None
        frame, self._buffer = self._buffer[HEADER:end], self._buffer[end:]
        return frame

    def _reply(self, request: bytes) -> bytes | None:
        """What goes back over the wire; None: nothing."""
        if request == ASK_FOR_ERROR:
            return self._error_report()
        now, payload = self.pass_time(), request[:-2]
        try:
            if sealed(payload) != request or not payload:
                raise RefusalError(-12, 0, "wrong CRC")
            self._asked = payload[0]
            self.sessions += payload == FIRST
            if self.arm.model.tells_errors and self.faults.at(now, "error_flag"):
                raise RefusalError(-1, 0, "injected")
            return sealed(Answers(self.arm).answer(payload))
        except RefusalError as refusal:
            self._refused = refusal
            return sealed(bytes((ERROR_FLAG,))) if self.arm.model.tells_errors else None

    def _error_report(self) -> bytes:
        told = self._refused
        head = bytes((ERROR_REPORT, self._asked, told.code & 0xFF, told.axis))
        return sealed(head + told.text.encode().ljust(ERROR_TEXT, b"\0")[:ERROR_TEXT])

    def _break(self, now: float) -> None:
        """What goes wrong with the motors and sensors at `now` [s]."""
        crashed = self.faults.at(now, "crashed_motor")
        for number, motor in enumerate(self.arm.motors, 1):
            motor.stuck = self._has("stuck_motor", number, now)
            motor.stuck_at = motor.counter if self._has("stuck_encoder", number, now) else None
        self.arm.sensors.frozen = self.faults.at(now, "stuck_sensor") is not None
        if crashed and crashed not in self._crashed:
            self._crashed.append(crashed)
            self.arm.crash(max(crashed.which, 1))

    def _has(self, fault: str, number: int, now: float) -> bool:
        found = self.faults.at(now, fault)
        return found is not None and number == max(found.which, 1)
