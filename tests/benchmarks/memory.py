"""Memory while an hour of robot time is recorded; run as a program it tells the growth [MB]."""

import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from itertools import cycle, islice
from pathlib import Path

from imitation.robot import SECOND
from imitation.sample import Sample
from tests.benchmarks.figure import Figure
from tests.recording import made_up

STEPS = 90_000  # an hour at 25 Hz
SETTLED = STEPS // 10  # by then every buffer has had its largest filling
DIFFERENT = 1_000  # samples that are made up; then they come again at later times
MB = 2**20
# The index that ends the file grows by half a kB a second; what is recorded, by 1.5 MB a second.
BOUND = 5.0  # [MB]


def figures(folder: Path) -> Iterator[Figure]:
    """Growth after the first tenth of the hour, in a process of its own."""
    words = [sys.executable, "-m", "tests.benchmarks.memory", str(folder / "hour.mcap")]
    told = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    before, most = (float(word) for word in told.split())
    detail = f"resident {before:.1f} MB after 6 minutes, {most:.1f} MB at most after that"
    yield Figure("memory_growth_in_an_hour", most - before, "MB", BOUND, detail)


def record_an_hour(path: Path) -> Iterator[float]:
    """Record; tells the resident memory once a minute of robot time [MB]."""
    known = [sample for sample, _ in made_up.run(DIFFERENT)]
    with made_up.recorder(path) as recorder:
        for step, sample in enumerate(islice(cycle(known), STEPS)):
            recorder.write(_at(sample, step * made_up.PERIOD_NS), [made_up.truth(step)])
            if step * made_up.PERIOD_NS % (60 * SECOND) == 0:
                yield resident()


def resident() -> float:
    """Memory of this process that is in use [MB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / MB


def _at(sample: Sample, now: int) -> Sample:
    return replace(
        sample,
        seen=replace(sample.seen, time_ns=now, frame_time_ns=now),
        percept=replace(sample.percept, time_ns=now),
        applied=replace(sample.applied, time_ns=now),
    )


if __name__ == "__main__":
    told = list(record_an_hour(Path(sys.argv[1])))
    settled = len(told) * SETTLED // STEPS
    print(told[settled], max(told[settled:]))
