"""Fig. 7 and its claims, from numbers made by hand."""

from dataclasses import replace

import numpy as np
import pytest

from imitation.analysis.fig7 import Movement, Strip, draw_fig7
from imitation.analysis.fig7_claims import Asked, Deferred, claims_of_fig7
from imitation.analysis.figure_style import save
from imitation.analysis.triggers import Probe, Triggers
from imitation.visual_field import VisualField

ASKED = Asked(
    grasped=0.9,
    placed=0.85,
    median_s=0.5,
    largest_s=1.5,
    clock=0.02,
    tick_s=0.04,
    frechet_points=20,
    resamples=50,
)
FIELD = VisualField("right_4x4", (160, 120), 4, 4, 40.0)
AREAS = [(2, 0), (2, 2), (2, 4)]
WAY = np.column_stack((np.linspace(85, 145, 20), np.full(20, 75.0)))


def triggers(wrong: int = 0) -> Triggers:
    """The middle of every area tried; the first `wrong` ones trigger what they should not."""
    states = {area: k for k, area in enumerate(AREAS[:-1])}
    found = [Probe(FIELD.centres[area], states.get(area)) for area in np.ndindex(FIELD.shape)]
    bad = [replace(one, triggered=1) for one in found[:wrong]]
    return Triggers(FIELD, AREAS, [*bad, *found[wrong:]])


def run(aside: float = 5.0, wrong: int = 0, **changes) -> Deferred:
    """A run in which all came true but for `changes`; the other arm goes `aside` px."""
    told = {
        "order_correct": True,
        "grasped": True,
        "object_error_m": 0.01,
        "timing_error_s": [0.1],
        "clock_error_s": [0.0],
        "delays_s": [2.0],
    }
    empty = {**told, "grasped": False, "object_error_m": None}
    conditions = {"seen": {**told, **changes}, "without a can": empty, "precision=area": told}
    paths = {"Katana": WAY, "other arm": WAY + np.array((0, aside))}
    return Deferred(conditions, paths, triggers(wrong))


def failed(runs) -> list[str]:
    return [claim.sentence for claim in claims_of_fig7(runs, ASKED) if not claim.passed]


def test_all_claims_come_true_when_the_action_is_reproduced():
    assert failed([run() for _ in range(20)]) == []


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"aside": 31.0}, "Katana's path"),
        ({"wrong": 1}, "nowhere else"),
        ({"order_correct": False}, "Order"),
        ({"timing_error_s": [1.6]}, "largest"),
    ],
)
def test_what_fails_is_said(wrong, words):
    runs = [*(run() for _ in range(19)), run(**wrong)]
    assert any(words in sentence for sentence in failed(runs))


def test_what_nothing_is_asked_of_is_a_report():
    claims = claims_of_fig7([run() for _ in range(20)], ASKED)
    assert all(claim.asked > 0 for claim in claims if claim.comparison != "reported")
    reports = [claim.sentence for claim in claims if claim.comparison == "reported"]
    assert len(reports) == 2
    assert all("precision=area." in sentence for sentence in reports)


def test_the_figure_is_drawn_and_saved(tmp_path):
    picture = np.zeros((33, 48, 3), dtype=np.uint8)
    strips = [Strip("demonstration", [Movement(picture, np.array(((5, 30), (20, 30))))])]
    figure, _ = draw_fig7(strips, [run()], ASKED)
    assert all(path.stat().st_size > 0 for path in save(figure, tmp_path, "fig7"))
