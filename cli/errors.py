"""Turns what a user got wrong into one line, and says which errors are a user's."""

import linecache
import sys
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from typing import Any

DONE, NOT_TRUE, BAD_INPUT, DEVICE, INTERRUPTED = 0, 1, 2, 3, 130


class UserError(Exception):
    """Something a user can put right; its text is the one line to show."""


def say(text: str) -> None:
    """Put one line on stderr."""
    print(f"imitate: {' '.join(text.split())}", file=sys.stderr, flush=True)


def nearest(word: str, valid: Iterable[str]) -> str:
    """'; did you mean ...?' with the nearest valid name, or nothing."""
    close = get_close_matches(word, list(valid), n=1, cutoff=0.5)
    return f"; did you mean {close[0]}?" if close else ""


def no_such(kind: str, word: str, valid: Sequence[str]) -> str:
    """That `word` is not among the choices, with the nearest and all of them."""
    named = word or "without a name"
    return f"there is no {kind} {named}{nearest(word, valid) or ';'} choose from {', '.join(valid)}"


def in_usage(error: Any) -> str:
    """What Typer found wrong with the words themselves, and what to type instead."""
    context, told = getattr(error, "ctx", None), error.format_message().rstrip(".")
    if isinstance(error.__cause__, ValueError):  # Pydantic's, which knows what came
        [wrong, *_] = error.__cause__.errors()  # type: ignore[attr-defined]
        wanted = wrong["msg"].removeprefix("Input ").partition(",")[0]
        told = f"{error.param.opts[0]} {wrong['input']} {wanted}"
    if context is None:
        return f"{told}; see imitate --help"
    usage = " ".join(context.command.collect_usage_pieces(context))
    typed = f"{context.command_path} {usage.translate(str.maketrans('', '', '{}'))}"
    return f"{told}; type {typed}, or see {context.command_path} --help"


def is_refusal(error: Exception) -> bool:
    """Whether `error` was raised on purpose, by a check at some door, rather than by a bug.

    A check is a `raise ValueError(...)`; NumPy's own ValueErrors come out of a call.
    """
    if isinstance(error, UserError):
        return True
    trace = error.__traceback__
    if not isinstance(error, ValueError) or trace is None:
        return False
    while trace.tb_next is not None:
        trace = trace.tb_next
    line = linecache.getline(trace.tb_frame.f_code.co_filename, trace.tb_lineno)
    return line.strip().startswith("raise")
