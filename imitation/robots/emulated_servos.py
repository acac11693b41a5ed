"""Emulated bus servos: their tables of registers, and how they move."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from imitation.robots.servo_packets import DynamixelPackets, FeetechPackets, Packets

TURN = 4096  # steps
LOWEST, HIGHEST, TORQUE_ON, GOAL, SPEED = "lowest", "highest", "torque on", "goal", "speed"
POSITION, VELOCITY, LOAD = "position", "velocity", "load"
MODEL, TORQUE_LIMIT, STATUS, TEMPERATURE = "model", "torque limit", "status", "temperature"
HOT, OVERLOADED = 4, 32  # bits of the status
COOL, TOO_HOT = 30, 80  # [degrees Celsius]
ACCESS_ERROR = 7  # a setting is only changed while the torque is off


@dataclass(frozen=True)
class Make:
    """What servos of one make are.

    Args:
        packets: How they speak.
        cells: Address and bytes of each register that is more than kept.
        initial: What the registers hold at first, bytes by address.
        speed_unit: Of speed and velocity [steps/s].
        unlimited: Speed when none is asked for [steps/s].
        load_unit: Of the load, when the register that limits the torque is at 1.
        sign_bit: A negative number has its sign in the highest bit; else it is a complement.
        locked: Below this address nothing is written while the torque is on.
    """

    packets: Packets
    cells: Mapping[str, tuple[int, int]]
    initial: Mapping[int, bytes]
    speed_unit: float
    unlimited: float
    load_unit: float
    sign_bit: bool
    locked: int


def _two(value: int) -> bytes:
    return value.to_bytes(2, "little")


def _four(value: int) -> bytes:
    return value.to_bytes(4, "little")


STS3215 = Make(
    packets=FeetechPackets(),
    cells={
        MODEL: (3, 2),
        LOWEST: (9, 2),
        HIGHEST: (11, 2),
        TORQUE_ON: (40, 1),
        GOAL: (42, 2),
        SPEED: (46, 2),
        TORQUE_LIMIT: (48, 2),
        POSITION: (56, 2),
        VELOCITY: (58, 2),
        LOAD: (60, 2),
        TEMPERATURE: (63, 1),
        STATUS: (65, 1),
    },
    initial={
        0: b"\x03\x0a",  # firmware
        3: _two(777),
        11: _two(TURN - 1),
        13: b"\x46",  # hottest
        42: _two(TURN // 2),
        48: _two(1000),
        62: b"\x79",  # voltage
    },
    speed_unit=1.0,
    unlimited=3073.0,
    load_unit=1.0,
    sign_bit=True,
    locked=0,
)


def _dynamixel(model: int, hottest: int, rpm: float, full_load: int) -> Make:
    return Make(
        packets=DynamixelPackets(),
        cells={
            MODEL: (0, 2),
            HIGHEST: (48, 4),
            LOWEST: (52, 4),
            TORQUE_ON: (64, 1),
            STATUS: (70, 1),
            TORQUE_LIMIT: (100, 2),
            SPEED: (112, 4),
            GOAL: (116, 4),
            LOAD: (126, 2),
            VELOCITY: (128, 4),
            POSITION: (132, 4),
            TEMPERATURE: (146, 1),
        },
        initial={
            0: _two(model),
            6: b"\x2d",  # firmware
            11: b"\x03",  # position mode
            31: bytes((hottest,)),
            36: _two(885),
            48: _four(TURN - 1),
            100: _two(885),
            116: _four(TURN // 2),
            144: _two(120),  # voltage
        },
        speed_unit=0.229 * TURN / 60,
        unlimited=rpm * TURN / 60,
        load_unit=full_load / 885,
        sign_bit=False,
        locked=64,
    )


MAKES = {
    "sts3215": STS3215,
    "xl330": _dynamixel(1200, 70, 103.0, 1750),
    "xl430": _dynamixel(1060, 72, 57.0, 1000),
    "xm430": _dynamixel(1020, 80, 46.0, 1193),
}


@dataclass
class EmulatedServo:
    """One servo: its registers, and where it is.

    Args:
        make: What it is.
        thing: What it cannot get below [steps]; None: nothing is in its way.
    """

    make: Make
    thing: int | None = None
    position: float = TURN / 2  # [steps]
    table: bytearray = field(default_factory=lambda: bytearray(256))

    def __post_init__(self) -> None:
        for address, value in self.make.initial.items():
            self.table[address : address + len(value)] = value
        self.put(POSITION, round(self.position))
        self.put(TEMPERATURE, COOL)

    def put(self, name: str, value: int) -> None:
        """Set a register."""
        address, size = self.make.cells[name]
        if value < 0 and self.make.sign_bit:
            value = -value | 1 << (8 * size - 1)
        told = (value % (1 << 8 * size)).to_bytes(size, "little")
        self.table[address : address + size] = told

    def get(self, name: str) -> int:
        """A register."""
        address, size = self.make.cells[name]
        return int.from_bytes(self.table[address : address + size], "little")

    def write(self, address: int, data: bytes) -> int:
        """Write registers; returns what is wrong with that, 0: nothing."""
        if address < self.make.locked and self.get(TORQUE_ON):
            return ACCESS_ERROR
        self.table[address : address + len(data)] = data
        return 0

    def go_on(self, seconds: float, stuck: bool, says_so: bool) -> None:
        """Move towards the goal for so long, unless `stuck`, and tell it when it `says_so`."""
        before, held = self.position, False
        if self.get(TORQUE_ON) and not stuck:
            goal = float(min(max(self.get(GOAL), self.get(LOWEST)), self.get(HIGHEST)))
            if held := self.thing is not None and goal < self.thing:
                goal = float(self.thing or 0)
            fastest = self.get(SPEED) * self.make.speed_unit or self.make.unlimited
            most = fastest * seconds
            self.position += min(max(goal - before, -most), most)
            held = held and self.position == goal
        moved = (self.position - before) / seconds / self.make.speed_unit if seconds else 0.0
        if says_so:
            self.put(POSITION, round(self.position))
        self.put(VELOCITY, round(moved) if says_so else 0)
        self.put(LOAD, round(self.get(TORQUE_LIMIT) * self.make.load_unit) if held else 0)
