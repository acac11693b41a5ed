"""What a run prints at its end: results, where the files are, the command to type next."""

import os
import shlex
from pathlib import Path

from rich.console import Console
from rich.table import Table

from cli.run import Outcome


def show(command: str, folder: Path, outcome: Outcome, cadence: list[tuple[str, str]]) -> None:
    """Print the results of a run on stdout."""
    console = Console(highlight=False, soft_wrap=True)
    table = Table(title=f"imitate {command}", title_justify="left", show_header=False)
    for name, value in [*outcome.rows, *cadence]:
        table.add_row(name, value)
    console.print(table)
    where = os.path.relpath(folder)
    where = str(folder) if where.startswith("..") else where
    files = " ".join(sorted(path.name for path in folder.iterdir()))
    console.print(f"files  {where}/  {files}", markup=False)
    console.print(f"next   {outcome.next.format(run=shlex.quote(where))}", markup=False)


def verdict(passed: bool) -> str:
    """Whether what was asked came true, in a word."""
    return "passed" if passed else "failed"
