"""Maps and reaches set by hand, for the figures of reaching."""

import numpy as np

from imitation.analysis.reached import MapReaches, ReachedTrial, Reaches, between_four, situation
from imitation.visual_field import VisualField
from imitation.visuo_motor_map import Learning, VisuoMotorMap

FIELD = VisualField("right_3x3", (160, 120), rows=3, columns=3, left=40.0)
CENTRAL = np.zeros(2)


def learned_map(shift=CENTRAL):
    """Nine areas, each learned `shift` px beside its centre, at made-up postures."""
    learning = Learning(alpha=1.0, min_activity=0.5, radius=0.4, excitation=0.8, inhibition=1.6)
    learned = VisuoMotorMap(FIELD, np.full(2, -1.0), np.full(2, 1.0), 1, learning)
    for row, column in np.argwhere(FIELD.reachable):
        place = FIELD.centres[row, column] + shift
        learned.places[row, column, 0] = place
        learned.postures[row, column, 0] = place / 160
        learned.visits[row, column] = 1
    return learned


def trial(start, target, seconds, limit=60.0, final=2.0):
    """Straight from `start` to within `final` px of `target`, reached when that is below 3."""
    trial = ReachedTrial(limit)
    times = np.linspace(0.0, seconds, 11)
    ends = np.add(target, (final, 0.0))
    trial.times = times.tolist()
    trial.hands = list(np.linspace(start, ends, 11))
    trial.distances = [float(np.linalg.norm(hand - target)) for hand in trial.hands]
    if final < 3.0:
        trial.reached_s = trial.held_s = trial.times[-1]
        trial.held = True
    return trial


def reaches(where, seconds, count, **more):
    starts = FIELD.centres[:, 1:].reshape(-1, 2)[:count]
    return Reaches(where, tuple(trial(start, where.target, seconds, **more) for start in starts))


def run(paper_s=4.0, noise_s=30.0, noise_final=2.0, paper_final=2.0):
    """A map 12 px beside the areas' centres, and what each controller made of it."""
    learned = learned_map(np.array((12.0, 0.0)))
    four = between_four(learned, 30.0, 25.0)
    at_learned = situation(learned, learned.places[1, 1, 0], 30.0)
    return MapReaches(
        learned,
        (reaches(at_learned, paper_s, 2),),
        reaches(four, paper_s, 6, final=paper_final),
        {
            "noise": reaches(four, noise_s, 3, final=noise_final),
            "nearest": reaches(four, 1.0, 1, final=20.0),
            "corrected_aim": reaches(four, 1.0, 6),
        },
    )
