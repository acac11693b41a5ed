"""imitate figure: the figures that run what they need."""

import json
from pathlib import Path

import numpy as np
import pytest

from cli.every_seed import on_every_seed
from cli.jobs.figure import show
from imitation.analysis.claims import every_claim

IDEAL = "experiment.both=['robot=ideal']"
SHORT = "experiment.reaching=['controller=yuragi','reach.limit=3']"


def squared(seed):
    return seed**2


@pytest.mark.parametrize("workers", [1, 2])
def test_results_come_in_the_order_of_the_seeds(workers, capsys):
    assert on_every_seed("fig0", squared, [3, 1, 2], workers) == [9, 1, 4]
    assert "fig0 · 3 of 3 seeds" in capsys.readouterr().err


def test_claims_are_printed_and_reports_counted(capsys):
    claim = every_claim("All succeed.", np.ones(3))
    show("fig9", [claim], 3, [Path("fig9.png"), Path("fig9.claims.json")])
    told = capsys.readouterr().out
    assert "All succeed." in told and "at least 1 " in told
    assert "told   2 more values, in fig9.claims.json" in told


@pytest.mark.slow
def test_fig2_is_what_ran_on_the_ideal_arm_too(imitate):
    result = imitate("figure", "fig2", "seeds=1", f"figure.fig2.{IDEAL}")
    assert result.exit_code == 0, result.output
    told = json.loads((imitate.folder / "data/figures/fig2.claims.json").read_text())
    assert [claim["passed"] for claim in told["claims"]] == [True, True]


def test_fig4_on_one_map_is_drawn_and_marked_as_a_demo(imitate):
    words = (f"figure.runs.{IDEAL}", f"figure.runs.{SHORT}")
    result = imitate("figure", "fig4", "demo=true", "demo_seeds=1", "out=here", *words)
    assert result.exit_code == 0, result.output
    told = json.loads((imitate.folder / "here/fig4.claims.json").read_text())
    assert (told["figure"], told["demo"], told["seeds"]) == ("fig4", True, 1)
    assert {path.name for path in (imitate.folder / "here").iterdir()} == {
        "fig4.png",
        "fig4.pdf",
        "fig4.claims.json",
    }


def test_a_claim_that_fails_is_exit_code_1_unless_it_is_a_demo(imitate):
    # Three trials are too few to be sure of a rate.
    words = ("seeds=1", "demo_seeds=1", f"figure.runs.{IDEAL}", f"figure.runs.{SHORT}")
    result = imitate("figure", "fig4", *words)
    assert result.exit_code == 1
    assert "did not come true" in result.stderr


def test_fig1_needs_the_engine_and_sees_the_hand_where_it_is(imitate):
    few = ("figure.fig1.postures=20", "figure.fig1.dense=20000", "figure.fig1.portrait.finer=1")
    result = imitate("figure", "fig1", "seeds=1", *few)
    assert result.exit_code == 0, result.output


@pytest.mark.slow
def test_fig5_stands_beside_the_other_controllers(imitate):
    limited = "figure.runs.experiment.reaching=['controller=yuragi','reach.limit=5']"
    result = imitate("figure", "fig5", "demo=true", "demo_seeds=1", limited)
    assert result.exit_code == 0, result.output
    told = json.loads((imitate.folder / "data/figures/fig5.claims.json").read_text())
    assert len(told["claims"]) == 10


@pytest.mark.slow
def test_fig6_shows_what_makes_the_imitation(imitate):
    words = ("demo=true", "demo_seeds=1", "figure.fig6.gestures=[line]", "figure.fig6.shuffles=3")
    result = imitate("figure", "fig6", *words, f"figure.fig6.{IDEAL}")
    assert result.exit_code == 0, result.output
    told = json.loads((imitate.folder / "data/figures/fig6.claims.json").read_text())
    assert all(claim["passed"] for claim in told["claims"])
