"""How the motors of an emulated Katana move: ramps, splines and stops, in ticks of 10 ms."""

from collections import deque
from dataclasses import dataclass, field
from enum import Enum, auto

from imitation.robots.katana.commands import Segment, Status
from imitation.robots.katana.models import Motor

BUFFER = 16  # segments a motor holds; a guess, nobody wrote it down
MOVING_PWM = 40


class Doing(Enum):
    """What a motor is at."""

    OFF = auto()
    HOLDING = auto()
    MOVING = auto()
    ARRIVED = auto()
    ON_SPLINE = auto()
    SPLINE_DONE = auto()
    CRASHED = auto()
    CALIBRATING = auto()


NEW = {
    Doing.OFF: Status.OFF,
    Doing.HOLDING: Status.HOLDING,
    Doing.MOVING: Status.MOVING,
    Doing.ARRIVED: Status.HOLDING,
    Doing.ON_SPLINE: Status.MOVING,
    Doing.SPLINE_DONE: Status.SPLINE_DONE,
    Doing.CRASHED: Status.CRASHED,
    Doing.CALIBRATING: Status.CALIBRATING,
}
# A 300 never says that it has arrived (facts/katana.md, 2.3).
OLD = NEW | dict.fromkeys(
    (Doing.MOVING, Doing.ARRIVED, Doing.ON_SPLINE, Doing.SPLINE_DONE), Status.NORMAL
)


@dataclass
class EmulatedMotor:
    """One motor: where it is, what its counter says, and what it is doing."""

    data: Motor
    position: float  # true [encoders]
    shift: int = 0  # the counter says position + shift
    velocity: float = 0.0  # [encoders / tick]
    doing: Doing = Doing.HOLDING
    speed: int = 30  # limit [encoders / tick]
    acceleration: int = 1  # [encoders / tick^2]
    stuck: bool = False
    stuck_at: int | None = None  # what the counter says wherever it is
    thing: int | None = None  # what the counter cannot get below
    target: float = 0.0  # true
    spline: deque[Segment] = field(default_factory=deque)
    waiting: list[Segment] = field(default_factory=list)  # in the buffer, not started
    ticks: int = 0  # since the segment began

    def __post_init__(self) -> None:
        self.speed = self.data.speed

    @property
    def counter(self) -> int:
        """What the encoder counter says, 16 bits with sign."""
        if self.stuck_at is not None:
            return self.stuck_at
        return (round(self.position) + self.shift + 0x8000) % 0x10000 - 0x8000

    @counter.setter
    def counter(self, value: int) -> None:
        self.shift = value - round(self.position)

    def move(self, target: int) -> None:
        """Go to where the counter says `target`."""
        self.forget_splines()
        self.target, self.doing = target - self.shift, Doing.MOVING

    def stop(self, doing: Doing) -> None:
        """Stop where it is."""
        self.forget_splines()
        self.velocity, self.doing = 0.0, doing

    def forget_splines(self) -> None:
        """Empty the move buffer."""
        self.spline.clear()
        self.waiting.clear()

    def start(self) -> None:
        """Begin, or go on with, the splines that wait."""
        if self.waiting and not self.spline:
            self.ticks, self.doing = 0, Doing.ON_SPLINE
        self.spline.extend(self.waiting)
        self.waiting.clear()

    def advance(self, ticks: int) -> None:
        """Let so many ticks of 10 ms pass."""
        for _ in range(ticks):
            if self.doing is Doing.MOVING:
                self._ramp()
            elif self.doing is Doing.ON_SPLINE:
                self._follow()
            else:
                return

    def _ramp(self) -> None:
        gap = self.target - self.position
        brake = (2 * self.acceleration * abs(gap)) ** 0.5
        sense = 1 if gap > 0 else -1
        ahead = max(sense * self.velocity, 0.0)
        speed = max(min(ahead + self.acceleration, self.speed, brake), 1.0)
        if abs(gap) <= speed and not self.stuck:
            self.position, self.velocity, self.doing = self.target, 0.0, Doing.ARRIVED
        else:
            self._go(self.position + sense * speed)

    def _follow(self) -> None:
        segment, self.ticks = self.spline[0], self.ticks + 1
        t = self.ticks
        there = (
            segment.p0 + segment.p1 * t / 64 + segment.p2 * t**2 / 1024 + segment.p3 * t**3 / 32768
        )
        # Coefficients are rounded to 16 bits: a segment ends on its target all the same.
        self._go((segment.target if t >= segment.ticks else there) - self.shift)
        if t >= segment.ticks:
            self.spline.popleft()
            self.ticks = 0
            if not self.spline:
                self.velocity, self.doing = 0.0, Doing.SPLINE_DONE

    def _go(self, to: float) -> None:
        """Move to `to`, no further than the mechanical stops."""
        lowest, highest = self.data.limits
        if self.thing is not None:
            lowest = max(lowest, self.thing - self.shift)
        there = self.position if self.stuck else min(max(to, lowest), highest)
        self.velocity, self.position = there - self.position, there
