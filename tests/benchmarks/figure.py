"""One measured figure and the bound it must keep."""

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter


@dataclass(frozen=True)
class Figure:
    """What was measured."""

    name: str
    value: float
    unit: str
    bound: float  # the largest value allowed
    detail: str  # what the value is made of, for people

    @property
    def passed(self) -> bool:
        """Whether the bound is kept."""
        return self.value <= self.bound

    def entry(self) -> dict[str, object]:
        """What bench.json says of it."""
        told = {"value": round(self.value, 3), "unit": self.unit, "bound": self.bound}
        return {**told, "pass": self.passed}


def timed(work: Callable[[], object]) -> float:
    """How long `work` takes [s]."""
    start = perf_counter()
    work()
    return perf_counter() - start
