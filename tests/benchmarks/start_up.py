"""Start-up of the program against the least that a Typer program needs."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from tests.benchmarks.figure import Figure, timed

ROUNDS = 10


def figures() -> Iterator[Figure]:
    """Start-up of `imitate --help` against `import typer`."""
    program = str(Path(sys.executable).with_name("imitate"))
    commands = {"help": [program, "--help"], "typer": [sys.executable, "-c", "import typer"]}
    times: dict[str, list[float]] = {name: [] for name in commands}
    for _ in range(ROUNDS):
        for name, words in commands.items():
            times[name].append(timed(lambda words=words: _run(words)))  # type: ignore[misc]
    ours, least = min(times["help"]), min(times["typer"])
    detail = f"imitate --help {ours * 1e3:.0f} ms / import typer {least * 1e3:.0f} ms"
    yield Figure("help_start_up", ours / least, "times", 3.0, detail)


def _run(words: list[str]) -> None:
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
