"""Where the program starts: Ctrl-C and SIGTERM end it quietly while its parts are still loaded."""

import os
import signal
from types import FrameType
from typing import Any

from cli.errors import INTERRUPTED
from cli.interruption import SIGNALS


def main() -> Any:
    """Load the program, which takes a while, and run it."""
    for number in SIGNALS:
        signal.signal(number, _end_at_once)
    from cli.main import main as program

    for number in SIGNALS:
        signal.signal(number, signal.default_int_handler)
    try:
        return program()
    except KeyboardInterrupt:  # before there was anything to close
        return INTERRUPTED


def _end_at_once(number: int, frame: FrameType | None) -> None:
    os._exit(
        INTERRUPTED
    )  # nothing is open yet, and an exception would end in the middle of an import
