"""Calls `imitate` as a user would, on the ideal arm, in a folder of its own."""

import json
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from cli.main import app
from cli.metrics_file import PROMISED
from cli.verify import verify

for beside in ("recording", "robots"):  # where tampering.py and made_up_films.py are
    sys.path.insert(0, str(Path(__file__).parents[1] / beside))


@dataclass
class Imitate:
    """Types a command in an empty folder."""

    folder: Path

    def __call__(self, *words: str) -> Result:
        return CliRunner().invoke(app, list(words))


@pytest.fixture
def imitate(tmp_path, monkeypatch) -> Iterator[Imitate]:
    """The program; every run that a test makes with it is decided anew at the end.

    And whatever became of it, its metrics.json holds what the contract promises.
    """
    monkeypatch.chdir(tmp_path)
    yield Imitate(tmp_path)
    for told in tmp_path.rglob("metrics.json"):
        metrics = json.loads(told.read_text() or "{}")
        assert set(PROMISED.get(metrics.get("command"), ())) <= set(metrics)
        if metrics.get("status") == "done" and (told.parent / "run.mcap").is_file():
            assert verify(told.parent) == 0


@pytest.fixture(scope="session")
def ran(tmp_path_factory) -> Callable[..., Path]:
    """Runs a command on the ideal arm and returns its folder, which many tests may look at."""

    def finished(command: str, *words: str) -> Path:
        folder: Path = tmp_path_factory.mktemp(command) / "run"
        told = CliRunner().invoke(app, [command, "robot=ideal", *words, f"out={folder}"])
        assert told.exit_code == 0, told.output
        return folder

    return finished


@pytest.fixture(scope="session")
def learned(ran) -> Path:
    """Folder of a finished learn-map run, shared by all tests: not to be changed."""
    return ran("learn-map")


@pytest.fixture(scope="session")
def reached_shortly(ran, learned) -> Path:
    """Folder of a few steps of reaching, shared by all tests: not to be changed."""
    return ran("reach", "reach.limit=1.2", "reach.required=0", f"map={learned}")
