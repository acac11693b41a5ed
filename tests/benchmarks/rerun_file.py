"""Deriving the Rerun file of a run against the time the run took."""

from collections.abc import Iterator
from pathlib import Path

from imitation.recording.rerun_view import derive
from tests.benchmarks.figure import Figure, timed
from tests.benchmarks.reaching import Reach

ROUNDS = 4
TRIALS = 25


def figures(folder: Path) -> Iterator[Figure]:
    """Derivation against the run's loop; the map is learned already."""
    runs, derivations = [], []
    for number in range(ROUNDS):
        reach = Reach(folder / f"derived-{number}", "corrected_aim", TRIALS, steps=10_000).go()
        reach.bench.robot.close()
        runs.append(reach.wall_time)
        rrd = reach.folder / "run.rrd"
        derivations.append(timed(lambda rrd=rrd: derive(rrd.parent, rrd)))  # type: ignore[misc]
    took, run = min(derivations), min(runs)
    detail = f"{took:.2f} s / {run:.2f} s, {len(reach.movements)} steps"
    yield Figure("rrd_derivation", took / run, "of the run", 0.5, detail)
