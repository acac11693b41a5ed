"""An emulated Katana behind its wire: motors, calibration, crashes (facts/katana.md, 2.3, 2.4)."""

from dataclasses import dataclass, field

from imitation.robots.katana.commands import TICK, Flag, Segment, Setting
from imitation.robots.katana.emulated_motors import BUFFER, NEW, OLD, Doing, EmulatedMotor
from imitation.robots.katana.models import Model
from imitation.robots.katana.sensors import EmulatedSensors

CALIBRATION = 1.5  # how long the arm calibrates itself; a real one takes its time [s]
JUST_ON = 4000  # where a motor that was just switched on stands from its stop [encoders]
BUFFER_FULL = 152
DO_NOT_START = 2  # moreflag of a spline that waits


class RefusalError(Exception):
    """The arm does not do that: an error flag on a 400 or 450, silence on a 300."""

    def __init__(self, code: int, axis: int, text: str) -> None:
        super().__init__(text)
        self.code, self.axis, self.text = code, axis, text


@dataclass
class EmulatedArm:
    """The motors and sensors of one Katana.

    Args:
        model: Which Katana it is.
    """

    model: Model
    motors: list[EmulatedMotor] = field(init=False)
    sensors: EmulatedSensors = field(default_factory=EmulatedSensors)
    time: float = 0.0  # until when the motors have moved [s]
    _calibrated_at: float | None = None
    _counters_known: bool = True

    def __post_init__(self) -> None:
        self.motors = [EmulatedMotor(data, data.ready) for data in self.model.motors]

    def just_switched_on(self) -> None:
        """Forget the calibration."""
        self._counters_known = False
        for motor in self.motors:
            motor.position = motor.data.offset - JUST_ON * motor.data.stop
            motor.counter, motor.doing = 0, Doing.OFF

    def advance_to(self, time: float) -> None:
        """Let the motors move until `time` [s]."""
        if self._calibrated_at is not None and time >= self._calibrated_at:
            self._finish_calibration()
        self.motors[-1].thing = self.sensors.thing
        ticks = int((time - self.time) / TICK)
        self.time += ticks * TICK
        for motor in self.motors:
            motor.advance(ticks)

    def crash(self, number: int) -> None:
        """A motor collides: all stop, that one is blocked."""
        for motor in self.motors:
            motor.stop(Doing.HOLDING)
        self.motors[number - 1].doing = Doing.CRASHED

    def status(self, motor: EmulatedMotor) -> int:
        """What a motor says of itself."""
        if not self.model.tells_errors:
            return OLD[motor.doing]
        full = len(motor.spline) + len(motor.waiting) >= BUFFER
        return BUFFER_FULL if full else NEW[motor.doing]

    def has(self, number: int) -> bool:
        """Whether there is a motor of that number."""
        return 1 <= number <= len(self.motors)

    def control(self, number: int, flag: int, position: int) -> None:
        """C for one motor."""
        motor = self.motors[number - 1]
        if flag == Flag.MOVE:
            self._refuse_if_blocked(number)
            motor.move(position)
        elif flag in (Flag.OFF, Flag.FREEZE):
            motor.stop(Doing.OFF if flag == Flag.OFF else Doing.HOLDING)

    def control_all(self, flag: int) -> None:
        """C for all motors."""
        if flag == Flag.CALIBRATE and self.model.calibrates_itself:
            self._calibrated_at = self.time + CALIBRATION
            for motor in self.motors:
                motor.stop(Doing.CALIBRATING)
                motor.counter = 0
        elif flag == Flag.CLEAR and not self.model.calibrates_itself:
            for motor in self.motors:  # a 300 takes this for a movement: do not
                motor.move(0)
        elif flag in (Flag.CLEAR, Flag.FREEZE, Flag.OFF):
            for number in range(1, len(self.motors) + 1):
                self.control(number, Flag.OFF if flag == Flag.OFF else Flag.FREEZE, 0)
        else:
            raise RefusalError(-2, 0, "not for all motors")

    def set_counter(self, number: int, flag: int, position: int) -> None:
        """C + 128: tell a motor of a 300 where it is."""
        if self.model.calibrates_itself:
            raise RefusalError(-4, number, "this arm calibrates itself")
        motor = self.motors[number - 1]
        motor.stop(Doing.ARRIVED if flag == Flag.MOVE else Doing.HOLDING)
        motor.counter = position
        self._counters_known = True

    def set_parameter(self, number: int, setting: int, value: int) -> None:
        """S: what changes how the motor moves is obeyed."""
        if setting == Setting.SPEED:
            self.motors[number - 1].speed = max(value, 1)
        if setting == Setting.ACCELERATION:
            self.motors[number - 1].acceleration = max(value, 1)

    def take(self, number: int, segment: Segment) -> None:
        """A spline for a motor's buffer."""
        self._refuse_if_blocked(number)
        self.motors[number - 1].waiting.append(segment)

    def start(self, more: int) -> None:
        """Start the splines, unless more are to come first."""
        if more != DO_NOT_START:
            for motor in self.motors:
                motor.start()

    def _refuse_if_blocked(self, number: int) -> None:
        if self.motors[number - 1].doing is Doing.CRASHED:
            raise RefusalError(-10, number, f"StopperThread: collision on axis: {number}")
        if not self._counters_known and self.model.calibrates_itself:
            raise RefusalError(-3, number, "not calibrated")

    def _finish_calibration(self) -> None:
        self._calibrated_at, self._counters_known = None, True
        for motor in self.motors:
            motor.position, motor.shift = motor.data.ready, 0
            motor.stop(Doing.HOLDING)
