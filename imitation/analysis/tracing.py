"""Watches one real step: which functions ran, in what order, and what they returned."""

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import CodeType, FrameType
from typing import Any


@dataclass(frozen=True)
class Call:
    """A function that ran during the step."""

    order: int  # when it was first entered, counted over the functions watched
    returned: Any


def watched(
    step: Callable[[], object], functions: Mapping[str, Callable[..., Any]]
) -> dict[str, Call]:
    """Run `step` and return the first call of each of `functions` during it, by their names.

    A function that did not run is left out.
    """
    names = {code_of(function): name for name, function in functions.items()}
    entered: dict[str, int] = {}
    calls: dict[str, Call] = {}

    def notice(frame: FrameType, event: str, returned: Any) -> None:
        name = names.get(frame.f_code)
        if name is None:
            return
        if event == "call":
            entered.setdefault(name, len(entered))
        elif event == "return":
            calls.setdefault(name, Call(entered[name], returned))

    before = sys.getprofile()
    sys.setprofile(notice)
    try:
        step()
    finally:
        sys.setprofile(before)
    return calls


def code_of(function: Callable[..., Any]) -> CodeType:
    """The code that runs when `function` or a bound method is called."""
    code: CodeType = getattr(function, "__func__", function).__code__
    return code
