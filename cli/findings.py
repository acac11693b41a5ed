"""What `imitate doctor` finds: one line for each thing it looked at."""

from collections.abc import Callable
from dataclasses import dataclass

from cli.errors import UserError, is_refusal

PASS, WARN, FAIL = "pass", "warn", "fail"


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at."""

    subject: str
    verdict: str  # pass, warn or fail
    told: str  # what was found, and what to do about it
    device: bool = False  # whether it is a device


class Suspicious(UserWarning):
    """Raised by a look that found something odd which need not stop anybody."""


def look(subject: str, at: Callable[[], str], device: bool = False) -> Finding:
    """What looking `at` something tells, or why it failed."""
    try:
        return Finding(subject, PASS, at(), device)
    except Suspicious as odd:
        return Finding(subject, WARN, str(odd), device)
    except (RuntimeError, UserError, ImportError, OSError) as error:
        return Finding(subject, FAIL, str(error), device)
    except ValueError as error:
        if not is_refusal(error):
            raise
        return Finding(subject, FAIL, str(error), device)
