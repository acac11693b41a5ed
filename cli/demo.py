"""make demo: learn a map, reach with it, draw the figures, and say what came out."""

import json
import os
import shlex
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from cli.errors import DONE, NOT_TRUE
from cli.figures import FIGURES
from cli.folder import make_run_folder

# controller of reach: KEY=VALUE words; a control that seldom arrives would take minutes
REACHES = {
    "corrected_aim": ["trials=6"],
    "yuragi": ["trials=6"],
    "noise": ["trials=3", "reach.limit=20"],
    "nearest": ["trials=6", "reach.limit=5"],
}


def main() -> int:
    """Run the demo; a claim or a target that is missed does not fail it."""
    began = time.monotonic()
    folder = Path(os.path.relpath(make_run_folder(None, "demo")))
    worst = max(imitate(words) for words in commands(folder))
    summarise(folder, time.monotonic() - began)
    return DONE if worst == NOT_TRUE else worst


def commands(folder: Path) -> Iterator[list[str]]:
    """What is typed, one command after the other."""
    learned = folder / "learn-map"
    yield ["learn-map", f"out={learned}"]
    for controller, words in REACHES.items():
        words = [f"map={learned}", f"controller={controller}", *words]
        yield ["reach", *words, f"out={folder / f'reach-{controller}'}"]
    for figure in FIGURES:
        yield ["figure", figure, "demo=true", f"out={folder / 'figures'}"]


def imitate(words: Sequence[str]) -> int:
    """Run one command and return its exit code."""
    print(f"\n$ imitate {shlex.join(words)}", flush=True)
    program = [sys.executable, "-c", "from cli.main import main; main()"]
    return subprocess.run([*program, *words], check=False).returncode


def summarise(folder: Path, seconds: float) -> None:
    """Print what came out."""
    table = Table(title=f"demo, {seconds:.0f} s", title_justify="left")
    for heading in ("what", "measured here", "asked, or in the paper"):
        table.add_column(heading)
    for row in rows(folder):
        table.add_row(*row)
    console = Console(highlight=False, soft_wrap=True)
    console.print(table)
    console.print(f"files  {folder}/", markup=False)
    console.print(f"next   imitate view {folder / 'learn-map'}", markup=False)


def rows(folder: Path) -> Iterator[tuple[str, str, str]]:
    """What was measured, ours, the paper's value."""
    learned = read(folder / "learn-map" / "metrics.json")
    if learned:
        areas = f"{learned['areas_learned']} of {learned['areas_total']}"
        yield "areas learned", f"{areas} in {learned['robot_time_s']:.1f} s", ""
    for controller in REACHES:
        told = read(folder / f"reach-{controller}" / "metrics.json")
        if told:
            time_s = told["median_time_s"]
            time_told = "" if time_s is None else f", {time_s:.1f} s in the median"
            yield f"targets, {controller}", f"{told['success_rate']:.0%}{time_told}", ""
    for name in FIGURES:
        told = read(folder / "figures" / f"{name}.claims.json")
        for claim in told.get("claims", []):
            yield f"{name}: {claim['sentence']}", f"{claim['measured']:.3g}", f"{claim['asked']:g}"


def read(path: Path) -> dict[str, Any]:
    """A JSON file; empty when there is none, because its command failed."""
    if not path.is_file():
        return {}
    content: dict[str, Any] = json.loads(path.read_text())
    return content


if __name__ == "__main__":
    sys.exit(main())
