"""A sweep: one folder with one folder a job inside it, and the worst of their exit codes."""

import json
import os
from pathlib import Path
from typing import Any

from hydra.core.override_parser.overrides_parser import OverridesParser

from cli.errors import BAD_INPUT, UserError
from cli.printed import listing, on_stdout
from imitation.recording.json_file import write_json

TOLD = ".job-*.json"  # what each job leaves behind


def out_of(overrides: list[str]) -> str | None:
    """Where the sweep is to lie: the value of `out=`, or None."""
    words = [word for word in overrides if word.lstrip("+").startswith("out=")]
    if not words:
        return None
    [parsed] = OverridesParser.create().parse_overrides(words[-1:])
    if parsed.is_sweep_override():
        raise UserError(f"{words[-1]}: a sweep has one folder, with one folder a job inside it")
    value = parsed.value()
    return None if value is None else str(value)


def summary(folder: Path) -> int:
    """Gather the jobs' exit codes in sweep.json, print them, and return the worst."""
    jobs = sorted(told(folder), key=lambda one: int(one["job"]))
    write_json(folder / "sweep.json", {"jobs": jobs})
    for path in folder.glob(TOLD):
        path.unlink()
    rows = [(str(one["job"]), str(one["exit_code"]), " ".join(one["overrides"])) for one in jobs]
    console = on_stdout()
    console.print(listing("sweep", ("job", "exit code", "overrides"), rows))
    console.print(f"files  {os.path.relpath(folder)}/", markup=False)
    return max((int(one["exit_code"]) for one in jobs), default=BAD_INPUT)


def told(folder: Path) -> list[dict[str, Any]]:
    """What the jobs that ran have left behind: number, overrides, exit code."""
    return [json.loads(path.read_text()) for path in folder.glob(TOLD)]
