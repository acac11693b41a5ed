"""What commands print when they are done."""

from collections.abc import Iterable, Sequence

from rich.console import Console
from rich.table import Table


def on_stdout() -> Console:
    """Prints on stdout, with no line broken and no colours but those that are asked for."""
    return Console(highlight=False, soft_wrap=True)


def facts(title: str, rows: Iterable[tuple[str, str]]) -> Table:
    """A table of names and values."""
    table = Table(title=title, title_justify="left", show_header=False)
    for row in rows:
        table.add_row(*row)
    return table


def listing(title: str, headings: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    """A table with a heading over each column."""
    table = Table(*headings, title=title, title_justify="left")
    for row in rows:
        table.add_row(*row)
    return table
