"""Fig. 1: the claims about the hand in view."""

import numpy as np
import pytest
from made_up_reaches import FIELD

from imitation.analysis.fig1 import HandInView, Scene, Sightings, draw_fig1
from imitation.analysis.figure_style import save

SETTINGS = HandInView(inset_px=6.0, error_px=0.3, cell_px=40, covered=0.95, resamples=50)
SCENE = Scene(
    side=np.zeros((48, 64, 3), np.uint8),
    frame=np.zeros((120, 160, 3), np.uint8),
    hand=np.array((80.0, 60.0)),
    camera=np.array((30.0, 5.0)),
    base=np.array((30.0, 40.0)),
    mark=np.array((40.0, 30.0)),
    view=np.array(((30.0, 40.0), (50.0, 40.0), (50.0, 45.0), (30.0, 45.0))),
    joints=5,
)
PLACES = np.array(((80.0, 60.0), (100.0, 30.0), (158.0, 60.0)))
EVERYWHERE = FIELD.centres[:, 1:].reshape(-1, 2)


def claims(seen, reached=EVERYWHERE):
    return draw_fig1(SCENE, FIELD, [Sightings(PLACES, seen)], reached, SETTINGS)[1]


def test_a_hand_seen_where_it_is_makes_all_claims_true(tmp_path):
    figure, told = draw_fig1(SCENE, FIELD, [Sightings(PLACES, PLACES)], EVERYWHERE, SETTINGS)
    assert all(claim.passed for claim in told)
    assert all(path.stat().st_size > 0 for path in save(figure, tmp_path, "fig1"))


def test_a_place_at_the_edge_of_the_image_does_not_count():
    seen = PLACES.copy()
    seen[2] = np.nan
    visible, exact, _ = claims(seen)
    assert (visible.n, visible.passed, exact.passed) == (2, True, True)


def test_a_hand_that_is_lost_or_seen_elsewhere_is_found_out():
    seen = PLACES.copy()
    seen[0], seen[1] = np.nan, PLACES[1] + (0.0, 0.5)
    visible, exact, _ = claims(seen)
    assert not visible.passed
    assert exact.measured == pytest.approx(0.5)
    assert not exact.passed


def test_coverage_counts_the_cells_that_the_hand_comes_into():
    *_, covered = claims(PLACES, np.vstack((EVERYWHERE[:3], (10.0, 10.0))))
    assert covered.measured == pytest.approx(3 / 9)
    assert not covered.passed
