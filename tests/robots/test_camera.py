"""The hand is seen where it is, on every simulated camera."""

import numpy as np
import pytest
from on_bench import bench

from imitation.robot import Command

EDGE = 6.0  # nearer to the image's edges the mark is cut off [px]


@pytest.fixture(scope="module", params=["ideal", "katana_sim"])
def parts(request):
    parts = bench("learn-map", f"robot={request.param}", "camera.noise_px=0")
    yield parts
    parts.robot.close()


def mixtures(parts, count: int):
    """Random mixtures of the guided postures that show the whole mark, and where it truly is."""
    rng, found = np.random.default_rng(2), []
    while len(found) < count:
        seen = parts.robot.reset(rng.dirichlet(np.ones(len(parts.guided))) @ parts.guided)
        truth = parts.robot.truth()[-1].hand_px
        inside = (truth >= EDGE).all() and (truth <= np.array(parts.space.size) - EDGE).all()
        if inside:
            found.append((seen, truth))
    return found


def test_the_hand_is_seen_within_0_3_px_of_its_true_projection(parts):
    perception = parts.perception(parts.field)
    off = [perception.perceive(seen).hand - truth for seen, truth in mixtures(parts, 30)]
    assert np.linalg.norm(off, axis=1).max() < 0.3


def test_panning_over_a_still_hand_keeps_its_place_in_visual_space(parts):
    perception, straight = parts.perception(parts.field), np.array(parts.space.reference)
    robot, still = parts.robot, np.zeros(len(parts.guided[0]))
    place = perception.perceive(robot.reset()).hand
    for pan in (-0.05, -0.02, 0.03, 0.05):
        seen, _ = robot.step(Command(still, gaze=straight + np.array((pan, 0.0))))
        shift = abs(perception.detector.hand_pixels(seen.frame).mean(axis=0)[0] - place[0])
        assert shift > abs(pan) * parts.space.focal * 0.4  # in the image it does move
        assert perception.perceive(seen).hand == pytest.approx(place, abs=0.7)  # < 1 px in all


def test_camera_noise_moves_the_place_seen_by_as_much_as_it_says():
    parts = bench("learn-map", "robot=ideal", "camera.noise_px=2")
    perception, seen = parts.perception(parts.field), parts.robot.reset()
    places = []
    for _ in range(400):
        places.append(perception.perceive(seen).hand)
        seen, _ = parts.robot.step(Command(np.zeros(5)))
    assert np.std(places, axis=0) == pytest.approx([2.0, 2.0], rel=0.15)
    assert np.mean(places, axis=0) == pytest.approx(parts.robot.truth()[-1].hand_px, abs=0.5)
