"""The demo types commands that exist, with keys that compose."""

import pytest
from hydra import compose, initialize_config_module

from cli.check import checked
from cli.demo import commands, main, words_for
from cli.figures import FIGURES
from cli.verify import verify
from cli.words import understand


@pytest.mark.parametrize("typed", [*commands("demo-now"), *map(words_for, FIGURES)], ids=" ".join)
def test_a_command_of_the_demo_composes(typed):
    command, *words = typed
    if command == "figure":
        name = words.pop(0)
        words = [f"name={name}", f"figure={FIGURES[name][0]}", *words]
    with initialize_config_module("conf", version_base="1.3"):
        checked(command, compose(command.replace("-", "_"), understand(words).overrides))


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_the_demo_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main() == 0
    runs = list(tmp_path.rglob("run.mcap"))
    assert runs
    assert all(verify(run) == 0 for run in runs)
