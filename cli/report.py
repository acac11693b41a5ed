"""What a run prints at its end: results, where the files are, the command to type next."""

import os
import shlex
from pathlib import Path

from cli.printed import facts, on_stdout
from cli.run import Outcome


def show(command: str, folder: Path, outcome: Outcome, cadence: list[tuple[str, str]]) -> None:
    """Print the results of a run on stdout."""
    console = on_stdout()
    console.print(facts(f"imitate {command}", [*outcome.rows, *cadence]))
    where = os.path.relpath(folder)
    where = str(folder) if where.startswith("..") else where
    files = " ".join(sorted(path.name for path in folder.iterdir()))
    console.print(f"files  {where}/  {files}", markup=False)
    console.print(f"next   {outcome.next.format(run=shlex.quote(where))}", markup=False)


def verdict(passed: bool) -> str:
    """Whether what was asked came true, in a word."""
    return "passed" if passed else "failed"
