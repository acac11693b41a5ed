"""What a run prints at its end: results, where the files are, the command to type next."""

import os
import shlex
from pathlib import Path

from cli.printed import facts, on_stdout
from cli.run import Outcome


def show(command: str, folder: Path, outcome: Outcome, senses: list[tuple[str, str]]) -> None:
    """Print the results of a run on stdout."""
    on_stdout().print(facts(f"imitate {command}", [*outcome.rows, *senses]))
    show_files(folder, outcome.next)


def show_ended(folder: Path) -> None:
    """Print what is left of a run that did not come to its end."""
    recorded = (folder / "run.mcap").exists()
    show_files(folder, "imitate inspect {run}" if recorded else None)


def show_files(folder: Path, then: str | None) -> None:
    """Print where a run's files are, and the command to type next."""
    console = on_stdout()
    where = os.path.relpath(folder)
    where = str(folder) if where.startswith("..") else where
    files = " ".join(sorted(path.name for path in folder.iterdir()))
    console.print(f"files  {where}/  {files}", markup=False)
    if then:
        console.print(f"next   {then.format(run=shlex.quote(where))}", markup=False)


def verdict(passed: bool) -> str:
    """Whether what was asked came true, in a word."""
    return "passed" if passed else "failed"
