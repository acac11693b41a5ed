"""What commands print when they are done."""

from collections.abc import Iterable, Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

Cell = str | Text


def on_stdout() -> Console:
    """Prints on stdout, with no line broken and no colours but those that are asked for."""
    return Console(highlight=False, soft_wrap=True)


def facts(title: str, rows: Iterable[tuple[str, str]]) -> Table:
    """A table of names and values."""
    table = Table(title=_title(title), title_justify="left", show_header=False)
    for row in rows:
        table.add_row(*as_it_stands(row))
    return table


def listing(title: str, headings: Sequence[str], rows: Iterable[Sequence[Cell]]) -> Table:
    """A table with a heading over each column."""
    table = Table(*headings, title=_title(title), title_justify="left")
    for row in rows:
        table.add_row(*as_it_stands(row))
    return table


def as_it_stands(cells: Iterable[Cell]) -> Iterable[Text]:
    """Cells in which Rich takes nothing in square brackets for a colour."""
    return (cell if isinstance(cell, Text) else Text(cell) for cell in cells)


def _title(title: str) -> Text:
    return Text(title, style="table.title")
