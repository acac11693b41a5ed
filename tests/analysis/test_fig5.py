"""Fig. 5: distance against time, and the claims beside the other controllers."""

from dataclasses import replace

import pytest
from made_up_reaches import run

from imitation.analysis.fig5 import draw_fig5
from imitation.analysis.fig5_claims import Approaches, claims_of_fig5
from imitation.analysis.figure_style import save

SETTINGS = Approaches(
    tolerance_px=3.0, reached=0.95, nearest_px=15.0, held=0.98, held_s=2.0, resamples=50
)


def by_words(claims, words):
    [claim] = [claim for claim in claims if words in claim.sentence]
    return claim


def test_all_claims_come_true_when_the_paper_is_right():
    claims = claims_of_fig5([run() for _ in range(30)], SETTINGS)
    assert [claim.sentence for claim in claims if not claim.passed] == []
    assert by_words(claims, "takes longer").measured == pytest.approx(30.0 / 4.0)


def test_noise_as_fast_as_the_map_makes_its_claim_fail():
    claims = claims_of_fig5([run(noise_s=3.0) for _ in range(5)], SETTINGS)
    assert not by_words(claims, "takes longer").passed


def test_noise_that_never_arrives_counts_as_its_limit():
    claims = claims_of_fig5([run(noise_s=60.0, noise_final=9.0) for _ in range(5)], SETTINGS)
    assert by_words(claims, "takes longer").measured == pytest.approx(60.0 / 4.0)
    assert by_words(claims, "arrives too").measured == 1.0


def test_a_map_without_the_place_between_four_is_left_out(tmp_path):
    bare = replace(run(), at_learned=(), between=None, others={})
    figure, claims = draw_fig5([run(), bare], SETTINGS)
    assert by_words(claims, "A position not learned").n == 6
    assert all(path.stat().st_size > 0 for path in save(figure, tmp_path, "fig5"))
