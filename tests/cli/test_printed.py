"""Tables show what they are told, letter by letter."""

import io

from rich.console import Console

from cli.printed import facts, listing


def shown(table) -> str:
    console = Console(file=io.StringIO(), width=200)
    console.print(table)
    return console.file.getvalue()


def test_square_brackets_are_printed_as_they_stand():
    assert "[nan, nan] px" in shown(facts("runs/[a]", [("off by", "[nan, nan] px")]))
    assert "runs/[a]" in shown(facts("runs/[a]", [("robot", "ideal")]))
    assert "[bold]" in shown(listing("", ("word",), [("[bold]",)]))
