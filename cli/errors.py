"""Turns what a user got wrong into one line, and says which errors are a user's."""

import linecache
import sys
from collections.abc import Iterable, Sequence
from difflib import SequenceMatcher
from typing import Any

NEAR = 0.6  # so like what was typed is a name that may have been meant [0..1]
DONE, NOT_TRUE, BAD_INPUT, DEVICE, INTERRUPTED = 0, 1, 2, 3, 130


class UserError(Exception):
    """Something a user can put right; its text is the one line to show."""


def say(text: str) -> None:
    """Put one line on stderr."""
    print(f"imitate: {' '.join(text.split())}", file=sys.stderr, flush=True)


def nearest(word: str, valid: Iterable[str]) -> str:
    """'; did you mean ...?' with the nearest valid name, or nothing."""
    close = [one for one in _nearest_first(word, valid) if _likeness(word, one)]
    return f"; did you mean {close[0]}?" if close else ""


def no_such(kind: str, word: str, valid: Sequence[str]) -> str:
    """That `word` is not among the choices, with the nearest and all of them, nearest first."""
    near, choices = nearest(word, valid) or ";", ", ".join(_nearest_first(word, valid))
    return f"there is no {kind} {word or 'without a name'}{near} choose from {choices}"


def _nearest_first(word: str, valid: Iterable[str]) -> list[str]:
    return sorted(valid, key=lambda one: -_likeness(word, one))


def _likeness(word: str, one: str) -> float:
    """How sure it is that `word` was to be `one`, 0..1: 0 when it is not like it."""
    if not word or one == "none":
        return 0.0
    if one.startswith(word) or one.endswith(f".{word}"):
        return 1.0
    ratio = SequenceMatcher(None, word, one).ratio()
    return ratio if ratio >= NEAR else 0.0


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
