"""What an emulated Katana says to each command (facts/katana.md, 2.3 and 2.6)."""

import struct
from dataclasses import dataclass

from imitation.robots.katana.commands import SENSOR_CONTROLLER, Segment
from imitation.robots.katana.emulated_arm import EmulatedArm, RefusalError
from imitation.robots.katana.emulated_motors import MOVING_PWM
from imitation.robots.katana.frames import SIZES

FIRMWARE = {"300": (4, 30), "400": (1, 1), "450": (2, 1)}
READ = 240  # from this subcommand on S reads
INPUTS, OUTPUTS = 0x3F, 0x01  # of the digital ports
COUNTER = 128  # added to a motor's number: its counter is set


@dataclass(frozen=True)
class Answers:
    """Answers for an arm."""

    arm: EmulatedArm

    def answer(self, request: bytes) -> bytes:
        """Payload of the reply to the request with this payload.

        Raises:
            RefusalError: There is none.
        """
        asked, told = SIZES.get(request[0], (0, 0))
        if len(request) != asked:
            raise RefusalError(-2, 0, "unknown command")
        body: bytes = METHODS[request[0]](self, request)
        return (bytes((request[0] | 0x20,)) + body).ljust(told, b"\0")

    def _version(self, request: bytes) -> bytes:
        return bytes(FIRMWARE[self.arm.model.name])

    def _table(self, request: bytes) -> bytes:
        return b"".join(
            bytes((number, letter, 0, *SIZES[letter], letter | 0x20))
            for number, letter in enumerate(METHODS, 1)
        )

    def _identity(self, request: bytes) -> bytes:
        return f"Katana emulator {self.arm.model.name}".ljust(81).encode() + b"\r\n"

    def _echo(self, request: bytes) -> bytes:
        return b""

    def _motor_version(self, request: bytes) -> bytes:
        # Zeros even on a 400: the second byte says that it failed.
        return bytes((request[1], request[2], 2, 1)) if self.arm.has(request[1]) else b""

    def _control(self, request: bytes) -> bytes:
        number, flag, position = struct.unpack(">xBBh", request)
        if number == 0:
            self.arm.control_all(flag)
            return bytes((1, flag))
        motor = number % COUNTER
        if not self.arm.has(motor):
            return self._no_such_axis()
        try:
            if number == motor:
                self.arm.control(motor, flag, position)
            else:
                self.arm.set_counter(motor, flag, position)
        except RefusalError:
            if self.arm.model.tells_errors:
                raise
            return b""
        return bytes((number, flag))

    def _read_motor(self, request: bytes) -> bytes:
        if not self.arm.has(request[1]):
            return self._no_such_axis()
        motor = self.arm.motors[request[1] - 1]
        velocity = round(motor.velocity)
        pwm = MOVING_PWM if velocity else 0
        told = (request[1], self.arm.status(motor), motor.counter, velocity, pwm)
        return struct.pack(">BBhhB", *told)

    def _read_all(self, request: bytes) -> bytes:
        motors = self.arm.motors
        if request[1] == 1:
            return bytes(self.arm.status(motor) for motor in motors)
        if request[1] == 3:
            return struct.pack(">6h", *(motor.counter for motor in motors))
        raise RefusalError(-2, 0, "N reads 1 or 3")

    def _read_sensors(self, request: bytes) -> bytes:
        if request[1] != SENSOR_CONTROLLER:
            return self._no_such_axis()
        gripper = self.arm.motors[-1].counter
        return bytes((request[1], *self.arm.sensors.read(gripper, self.arm.time)))

    def _parameter(self, request: bytes) -> bytes:
        number, setting, value = request[1:4]
        if setting < READ and self.arm.has(number):
            self.arm.set_parameter(number, setting, value)
        return request[1:]

    def _segment(self, request: bytes) -> bytes:
        number, target, *rest = struct.unpack(">xBhHhhhh", request)
        if not self.arm.has(number):
            raise RefusalError(-2, 0, "no such axis")
        ticks, p0, p1, p2, p3 = rest  # G carries the target before the time, H the time first
        self.arm.take(number, Segment(ticks, target, p0, p1, p2, p3))
        return bytes((number,))

    def _segments(self, request: bytes) -> bytes:
        if not self.arm.model.moves_all:
            raise RefusalError(-2, 0, "unknown command")
        for number, values in enumerate(struct.iter_unpack(">Hhhhhh", request[1:-2]), 1):
            self.arm.take(number, Segment(*values))
        self.arm.start(request[-2])
        return b"\x01\x01"

    def _start_segments(self, request: bytes) -> bytes:
        self.arm.start(request[1])
        return b"\x01"

    def _limits(self, request: bytes) -> bytes:
        return b"\x01"

    def _digital(self, request: bytes) -> bytes:
        if not self.arm.model.tells_errors:
            raise RefusalError(-2, 0, "unknown command")
        return bytes((INPUTS if request[1:2] == b"r" else OUTPUTS,))

    def _slave(self, request: bytes) -> bytes:
        return request[1:]

    def _modbus(self, request: bytes) -> bytes:
        return b""

    def _no_such_axis(self) -> bytes:
        if self.arm.model.tells_errors:
            raise RefusalError(-2, 0, "no such axis")
        return b""


METHODS = {  # in the order in which X tells them
    ord("B"): Answers._version,
    ord("X"): Answers._table,
    ord("Y"): Answers._identity,
    ord("Z"): Answers._echo,
    ord("C"): Answers._control,
    ord("D"): Answers._read_motor,
    ord("E"): Answers._read_sensors,
    ord("V"): Answers._motor_version,
    ord("N"): Answers._read_all,
    ord("G"): Answers._segment,
    ord("G") + 128: Answers._start_segments,
    ord("H"): Answers._segments,
    ord("A"): Answers._limits,
    ord("S"): Answers._parameter,
    ord("I"): Answers._slave,
    ord("M"): Answers._modbus,
    ord("T"): Answers._digital,
}
