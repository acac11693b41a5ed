"""Fig. 4: trajectories in visual space and their claims."""

from dataclasses import replace

from made_up_reaches import run

from imitation.analysis.fig4 import Trajectories, draw_fig4
from imitation.analysis.figure_style import save

SETTINGS = Trajectories(reached=0.95, average_px=25.0, average_within_px=5.0, resamples=50)


def test_all_claims_come_true_when_every_hand_arrives():
    _, claims = draw_fig4([run() for _ in range(30)], SETTINGS)
    assert [claim.passed for claim in claims] == [True] * 4
    assert [claim.n for claim in claims] == [30, 30, 60, 180]


def test_hands_that_do_not_arrive_make_the_claim_fail():
    _, claims = draw_fig4([run(paper_final=9.0) for _ in range(30)], SETTINGS)
    assert [claim.passed for claim in claims] == [True, True, True, False]


def test_maps_without_such_places_leave_the_panels_empty(tmp_path):
    bare = replace(run(), at_learned=(), between=None, others={})
    figure, claims = draw_fig4([bare], SETTINGS)
    assert not any(claim.passed for claim in claims)
    assert all(path.stat().st_size > 0 for path in save(figure, tmp_path, "fig4"))


def test_it_is_saved_to_the_same_bytes_again(tmp_path):
    first, second = (
        [path.read_bytes() for path in save(draw_fig4([run()], SETTINGS)[0], tmp_path / name, "a")]
        for name in ("first", "second")
    )
    assert first == second
