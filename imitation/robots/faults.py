"""What goes wrong with an emulated or a simulated device, and when."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

WRITTEN = re.compile(
    r"(?P<name>\w+?)(=(?P<which>\d+))?(@(?P<start>\d+(\.\d+)?)(-(?P<end>\d+(\.\d+)?))?)?(x(?P<times>\d+))?"
)


@dataclass(frozen=True)
class Kind:
    """A way in which devices fail."""

    does: str
    parts: int = 0  # WHICH counts so many motors or servos from 1; 0: it is the device's as a whole


@dataclass(frozen=True)
class Fault:
    """Something that goes wrong for a while."""

    name: str
    which: int  # motor, servo or sensor; 0: the device as a whole
    start: float  # since the device was first spoken to [s]
    end: float
    times: float  # how often it strikes

    def lasts(self, time: float) -> bool:
        """Whether it goes wrong at `time` [s]."""
        return self.start <= time < self.end


def read_fault(written: str, known: Mapping[str, Kind]) -> Fault:
    """A fault as it is typed: NAME[=WHICH][@START[-END]][xTIMES], such as late@1-2.5x3."""
    match = WRITTEN.fullmatch(written)
    if not match or match["name"] not in known:
        raise ValueError(
            f"there is no fault {written}; type NAME[=WHICH][@START[-END]][xTIMES] (seconds), "
            f"with a NAME of {', '.join(known)}"
        )
    start, end = float(match["start"] or 0), float(match["end"] or "inf")
    if end <= start:
        raise ValueError(f"fault {written} ends before it begins; type {match['name']}@START-END")
    times = float(match["times"] or "inf")
    return Fault(match["name"], _which(match, known[match["name"]].parts), start, end, times)


def _which(match: re.Match[str], parts: int) -> int:
    name, typed = match["name"], match["which"]
    if typed is None:
        return 0
    if not parts:
        raise ValueError(
            f"fault {match[0]}: {name} is of the whole device; type it without a WHICH"
        )
    if not 1 <= float(typed) <= parts:
        raise ValueError(f"fault {match[0]}: there is no {typed}; type {name}=1 to {name}={parts}")
    return int(typed)


def nothing(name: str) -> None:
    """No fault."""


def lasting(name: str, at: float, lasts: float | None) -> Fault:
    """A fault of a whole device from `at` [s] on, for so long [s]; None: for good."""
    return Fault(name, 0, at, float("inf") if lasts is None else at + lasts, float("inf"))


@dataclass(frozen=True)
class Faults:
    """All that goes wrong with one device."""

    planned: Sequence[Fault] = ()
    _struck: dict[Fault, int] = field(default_factory=dict)

    def at(self, time: float, name: str) -> Fault | None:
        """The fault of that name that lasts at `time` [s]."""
        return next((one for one in self.planned if one.name == name and one.lasts(time)), None)

    def strikes(self, time: float, name: str) -> bool:
        """Whether that fault spoils what is sent at `time` [s]; counts."""
        fault = self.at(time, name)
        if fault is None or self._struck.get(fault, 0) >= fault.times:
            return False
        self._struck[fault] = self._struck.get(fault, 0) + 1
        return True
