"""metrics.json holds what the contract promises, whatever became of the run."""

import json

import pytest

from cli.main import app
from cli.metrics_file import PROMISED, write_metrics
from cli.recompute import STAGES


def test_all_commands_that_move_an_arm_promise_something():
    assert set(PROMISED) == set(STAGES)
    assert set(PROMISED) <= {one.callback.__name__.replace("_", "-") for one in
                             app.registered_commands}  # fmt: skip


@pytest.mark.parametrize("command", PROMISED)
@pytest.mark.parametrize("status", ["done", "failed", "interrupted", "truncated"])
def test_what_was_not_measured_is_null(tmp_path, command, status):
    first, *others = PROMISED[command]
    write_metrics(tmp_path, command, {"command": command, "status": status, first: 1})
    told = json.loads((tmp_path / "metrics.json").read_text())
    assert (told["command"], told["status"], told[first]) == (command, status, 1)
    assert [told[key] for key in others] == [None] * len(others)


def test_numbers_are_told_without_the_noise_of_floating_point(tmp_path):
    noisy = {"a": 0.1 + 0.2, "b": [-0.0, 1e-17], "c": float("nan"), "d": 12345678901}
    write_metrics(tmp_path, "replay", noisy)
    text = (tmp_path / "metrics.json").read_text()
    assert '"a": 0.3,' in text
    assert "-0.0" not in text
    assert '"c": null' in text
    assert '"d": 12345678901' in text
