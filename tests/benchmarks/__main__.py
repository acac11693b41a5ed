"""Measures every figure, prints one table, writes data/bench.json; exit code 1 out of bounds."""

import json
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from rich.console import Console
from rich.table import Table

from tests.benchmarks import control_step, memory, rerun_file, start_up
from tests.benchmarks.figure import Figure

RESULTS = Path(__file__).parents[2] / "data" / "bench.json"
WIDTH = 120  # of the table [characters]


def main() -> int:
    """Measure, tell, judge."""
    with TemporaryDirectory(prefix="bench-") as name:
        folder = Path(name)
        figures = [
            *start_up.figures(),
            *control_step.figures(folder),
            *rerun_file.figures(folder),
            *memory.figures(folder),
        ]
    RESULTS.write_text(json.dumps({one.name: one.entry() for one in figures}, indent=2) + "\n")
    Console(width=WIDTH).print(table(figures))
    return 0 if all(one.passed for one in figures) else 1


def table(figures: list[Figure]) -> Table:
    """What is printed."""
    drawn = Table(title="Ratios measured in one run, best of several rounds")
    for column in ("figure", "value", "at most", "", "made of"):
        drawn.add_column(column, justify="right" if column in ("value", "at most") else "left")
    for one in figures:
        value, bound = (f"{number:.3g} {one.unit}".strip() for number in (one.value, one.bound))
        drawn.add_row(one.name, value, bound, "pass" if one.passed else "FAIL", one.detail)
    return drawn


sys.exit(main())
