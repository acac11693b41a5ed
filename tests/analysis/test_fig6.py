"""Fig. 6 and its claims, from numbers made by hand."""

from dataclasses import replace

import numpy as np
import pytest
from made_up_reaches import learned_map

from imitation.analysis.fig6 import draw_fig6
from imitation.analysis.fig6_claims import Mimicking, claims_of_fig6
from imitation.analysis.figure_style import save
from imitation.analysis.imitations import Followed, Imitations, Smoothed, fastest_transition
from imitation.analysis.mirror import Aside

SETTINGS = Mimicking(
    slow=16.0,
    quick=4.0,
    follow_rate=0.95,
    above_floor_px=2.0,
    soft_px=6.0,
    lag_s=0.3,
    still_px=3.0,
    quantile=0.99,
    mirrored=0.95,
    resamples=50,
)
PATH = np.column_stack((np.linspace(60, 140, 20), np.full(20, 60.0)))


def followed(gesture: str, selection: str, period: float, rmse: float) -> Followed:
    told = {"path_rmse_px": rmse, "floor_rmse_px": 10.0, "lag_s": 0.3, "follow_rate": 1.0}
    told |= {"correlation": 0.99, "dtw_px": 2.0, "frechet_px": 5.0, "jitter_px": 0.1}
    return Followed(gesture, selection, period, told, PATH, PATH + 2)


def run(soft: float = 2.0, drawn: float = -6.0, correlation: float = 0.97) -> Imitations:
    return Imitations(
        learned=learned_map(),
        transition_s=0.8,
        followed=[
            followed(gesture, selection, period, rmse)
            for gesture in ("line", "circle")
            for selection, rmse in (("winner", 9.0), ("soft", soft))
            for period in (16.0, 4.0)
        ],
        smoothed=[
            Smoothed(one, tau, tau, 0.1 / tau) for one in ("winner", "soft") for tau in (0.1, 0.5)
        ],
        correlation=correlation,
        shuffled=np.linspace(-0.5, 0.8, 10),
        travelled={"no hand shown": 0.1, "self and other told apart": 0.1},
        mirror=[Aside(0, 0.1, 0.1), Aside(5, drawn, 5), Aside(20, -20, 20)],
    )


def failed(claims) -> list[str]:
    return [claim.sentence for claim in claims if not claim.passed]


def test_all_claims_come_true_when_the_arm_imitates():
    assert failed(claims_of_fig6([run() for _ in range(20)], SETTINGS)) == []


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"soft": 5.0}, "halves"),
        ({"drawn": 2.0}, "other side"),
        ({"correlation": 0.7}, "shuffled"),
    ],
)
def test_what_fails_is_said(wrong, words):
    found = failed(claims_of_fig6([run(**wrong) for _ in range(20)], SETTINGS))
    assert any(words in sentence for sentence in found)


def test_one_map_of_twenty_may_miss_before_the_mirror_but_not_two():
    good = [run() for _ in range(18)]
    one, two = ([*good, *[run()] * (2 - bad), *[run(drawn=2.0)] * bad] for bad in (1, 2))
    assert not failed(claims_of_fig6(one, SETTINGS))
    assert failed(claims_of_fig6(two, SETTINGS))


def test_the_figure_is_drawn_and_saved(tmp_path):
    figure, _ = draw_fig6([run(), replace(run(), correlation=0.9)], SETTINGS)
    assert all(path.stat().st_size > 0 for path in save(figure, tmp_path, "fig6"))


def test_the_fastest_transition_speeds_up_halfway_and_brakes_the_other_half():
    # A joint turns by 1/160 rad for each px, and neighbours are 40 px apart: 0.25 rad.
    assert fastest_transition(learned_map(), np.full(2, 1.0)) == pytest.approx(1.0)
