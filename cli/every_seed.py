"""The same work for each seed, several at a time, with a line that tells how far it is."""

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from multiprocessing import get_context
from typing import TypeVar

Seed = TypeVar("Seed")
Result = TypeVar("Result")


def on_every_seed(
    name: str,
    work: Callable[[Seed], Result],
    seeds: Sequence[Seed],
    workers: int,
    counted: str = "seeds",
) -> list[Result]:
    """What `work` returns for each seed, in their order.

    Args:
        name: Of the whole, for the progress line.
        work: Done for each seed; a function of a module, or a `partial` of one.
        seeds: For which.
        workers: Processes at a time; the engine has a world in each.
        counted: What they are, for the progress line, if not seeds.
    """
    workers = min(workers, len(seeds))
    if workers == 1:
        alone = (_numbered(work, one) for one in enumerate(seeds))
        return _gathered(name, alone, len(seeds), counted)
    with get_context("spawn").Pool(workers) as pool:  # its end ends the processes too
        done = pool.imap_unordered(partial(_numbered, work), list(enumerate(seeds)))
        return _gathered(name, done, len(seeds), counted)


def _numbered(work: Callable[[Seed], Result], numbered: tuple[int, Seed]) -> tuple[int, Result]:
    number, seed = numbered
    return number, work(seed)


def _gathered(
    name: str, done: Iterator[tuple[int, Result]], count: int, counted: str
) -> list[Result]:
    began, found = time.monotonic(), {}
    for number, result in done:
        found[number] = result
        _tell(f"{name} · {len(found)} of {count} {counted} · {time.monotonic() - began:.0f} s")
    if sys.stderr.isatty():
        print(file=sys.stderr)
    return [found[number] for number in range(count)]


def _tell(line: str) -> None:
    if sys.stderr.isatty():
        print(f"\r{line}\x1b[K", end="", file=sys.stderr, flush=True)
    else:
        print(line, file=sys.stderr, flush=True)
