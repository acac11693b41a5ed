"""`imitate reach` in this process, with a clock between its steps."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from time import perf_counter

from hydra import compose, initialize_config_module

from cli.build import Bench
from cli.check import checked
from cli.jobs.reach import reaching, trials_of
from imitation.arrays import Array
from imitation.recording.map_file import load_map
from imitation.recording.recorder import Recorder
from imitation.sample import Sample

MAP = "map"  # folder of the learned map, beside the runs


def learn_map(folder: Path) -> None:
    """Learn the map that all measurements reach with."""
    program = str(Path(sys.executable).with_name("imitate"))
    words = [program, "learn-map", f"out={folder / MAP}"]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


@dataclass(frozen=True)
class Movement:
    """What the arm did in one step."""

    velocity: Array  # sent to it, (n_joints,) [rad/s]
    start: Array | None  # (n_joints,) [rad], where a trial began, in a world rebuilt before


@dataclass
class Reach:
    """One run of `imitate reach` on katana_sim.

    Args:
        folder: Of the run; its parent holds the map.
        controller: Its name.
        trials: Reaches, each from its own start.
        steps: The run ends after this many.
    """

    folder: Path
    controller: str
    trials: int
    steps: int

    def __post_init__(self) -> None:
        self.folder.mkdir()
        self.stored = load_map(self.folder.parent / MAP)
        given = ["map=given", f"controller={self.controller}", f"trials={self.trials}"]
        with initialize_config_module("conf", version_base="1.3"):
            self.cfg = checked("reach", compose("reach", given))
        self.bench = Bench(self.cfg)
        self.movements: list[Movement] = []
        self.wall_time = 0.0  # of the whole run [s]
        self._times: list[float] = []  # of each step [s]

    def go(self, recorded: bool = True) -> "Reach":
        """Reach, measure, and record if asked to."""
        start = perf_counter()
        for _ in self.stepping(recorded):
            pass
        self.wall_time = perf_counter() - start
        return self

    def stepping(self, recorded: bool) -> Iterator[None]:
        """The same, step by step."""
        robot = self.bench.robot
        samples, metrics = reaching(self.bench, self.stored, trials_of(self.bench, self.stored))
        with ExitStack() as open_until_the_end:
            recorder = open_until_the_end.enter_context(self._recorder()) if recorded else None
            start = perf_counter()
            for sample in islice(samples, self.steps):
                truths = robot.truth()
                if recorder:
                    recorder.write(sample, truths)
                metrics.add(sample, truths)
                # Frames are not kept: every page of new memory would cost time no run spends.
                self.movements.append(_movement(sample))
                self._times.append(perf_counter() - start)
                yield
                start = perf_counter()

    @property
    def step_times(self) -> list[float]:
        """Wall time of each step [s]; those that rebuild the world for a new trial left out."""
        steps = zip(self.movements, self._times, strict=True)
        return [taken for movement, taken in steps if movement.start is None]

    def _recorder(self) -> Recorder:
        settings, robot = self.cfg["recording"], self.bench.robot
        return Recorder(
            self.folder / "run.mcap",
            body=robot.body,
            field=self.stored.map.field,
            period_ns=robot.period_ns,
            metadata={"command": "reach"},
            attachments={},
            max_loss=settings["max_loss"],
            reproducible=settings["reproducible"],
        )


def _movement(sample: Sample) -> Movement:
    begins = any(event.kind == "episode" for event in sample.events)
    return Movement(sample.applied.sent, sample.seen.posture if begins else None)
