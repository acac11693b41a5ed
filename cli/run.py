"""A run: its folder, recording, log and numbers, opened and closed here and nowhere else."""

import logging
import platform
import shlex
import time
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from omegaconf import OmegaConf

from cli.build import Bench, Config
from cli.confirm import confirm_motion
from cli.interruption import Interruption
from cli.metrics_file import write_metrics
from cli.progress import ProgressReport
from cli.provenance import run_record, sha256
from imitation.analysis.cadence import Cadence
from imitation.analysis.frame_count import FrameCount
from imitation.analysis.sight import Sight
from imitation.device import DeviceError
from imitation.recording.recorder import Happening, Recorder, RecorderError
from imitation.robot import SECOND, Truth
from imitation.robots.bullet.world import find_urdf
from imitation.sample import Event, Sample
from imitation.visual_field import VisualField

Watcher = Callable[[Sample, list[Truth]], None]

# What the files that a configuration names are called in a recording, wherever they came from.
ATTACHED = {"map": "map.npz", "action": "action.json"}


@dataclass(frozen=True)
class Outcome:
    """What a run brought."""

    metrics: dict[str, Any]
    rows: list[tuple[str, str]]  # what is printed of it: name, value
    next: str  # the command to type next
    complaint: str | None = None  # why the exit code is 1; None: all came true


@dataclass
class Run:
    """One run of a stage.

    Args:
        command: What was typed, such as learn-map.
        cfg: The composed configuration, checked.
        folder: Made for this run alone.
        typed: The KEY=VALUE words.
        sweep: Folder of the sweep whose job this is; None outside a sweep.
    """

    command: str
    cfg: Config
    folder: Path
    typed: Sequence[str]
    sweep: Path | None
    log: logging.Logger = field(init=False)
    status: str = ""  # as metrics.json says it; empty until it is written
    steps: int = 0
    robot_time_s: float = 0.0
    late_ticks: int = 0  # steps that took longer than a period of real time
    _cadence: Cadence = field(default_factory=Cadence)
    _frames: FrameCount = field(default_factory=FrameCount)
    _sight: Sight = field(default_factory=Sight)
    _inputs: dict[str, Path] = field(default_factory=dict)
    _began: float = field(default_factory=time.monotonic)

    def __post_init__(self) -> None:
        self.log = _log_to(self.folder / "log.txt")
        self.log.info("%s", shlex.join(["imitate", self.command, *self.typed]))
        self.log.info("on %s, %s", platform.node(), platform.platform())
        self.write_config()
        self.bench = Bench(self.cfg)

    @property
    def senses(self) -> list[tuple[str, str]]:
        """What is printed of what was seen, and how time was kept; nothing in simulation."""
        rate = self._cadence.rate
        if rate is None or not self.bench.robot.live:
            return self._sight.rows
        late = f"{self.late_ticks} of {self.steps} late"
        kept = f"{rate:.2f} of {1 / self.bench.robot.period:g}, {late}"
        return [*self._sight.rows, ("steps a second", kept)]

    def write_config(self) -> None:
        """Write config.yaml."""
        text = OmegaConf.to_yaml(OmegaConf.create(dict(self.cfg)))
        (self.folder / "config.yaml").write_text(text)

    def uses(self, key: str, path: Path) -> None:
        """Attach the file that the configuration's `key` names to the recording."""
        self._inputs[key] = path

    def record(
        self, samples: Iterator[Sample], visual_field: VisualField, watch: Watcher | None = None
    ) -> None:
        """Run the stage to its end, writing every step.

        Raises:
            KeyboardInterrupt: A signal asked for the end; the recording is closed and readable.
        """
        robot, attached = self.bench.robot, dict(self._attachments())
        watchers = [watch] if watch else []
        with ExitStack() as open_until_the_end:
            interruption = open_until_the_end.enter_context(
                Interruption(self.sweep, at_once=lambda: robot.leading)
            )
            recorder = open_until_the_end.enter_context(self._recorder(visual_field, attached))
            if self.cfg["recording"]["live"]:
                from imitation.recording.rerun_view import LiveView  # takes a second

                live = LiveView(robot.body, visual_field, attached)
                open_until_the_end.enter_context(closing(live))
                watchers.append(live.show)
            report = open_until_the_end.enter_context(ProgressReport(self.command))
            last_ns = 0  # when the last step was commanded [ns]
            try:
                confirm_motion(self.bench)
                for sample in self.bench.watched(until_interrupted(samples, interruption)):
                    truths = robot.truth()
                    for one in (recorder.write, *watchers):
                        one(sample, truths)
                    report.step(sample)
                    self._note(sample)
                    last_ns = sample.applied.time_ns
                robot.park(self.bench.rest)
            except DeviceError as error:
                robot.close()  # at once: the arm freezes
                recorder.tell(Happening(last_ns, Event("device", str(error))))
                raise
            except RecorderError:
                robot.rest()
                raise
        if interruption.wanted:
            raise KeyboardInterrupt

    def draw(self) -> None:
        """Derive run.rrd; a run without a step has nothing to show."""
        if self.steps:
            from cli.view import derive_rrd

            derive_rrd(self.folder / "run.mcap", self.folder / "run.rrd")

    def write_metrics(self, status: str, more: Config) -> None:
        """Write metrics.json; what is no number or was not measured becomes null."""
        self.status = status
        content = {
            "command": self.command,
            "status": status,
            "seed": self.cfg["seed"],
            "robot_time_s": self.robot_time_s,
            "wall_time_s": round(time.monotonic() - self._began, 3),
            "steps": self.steps,
            "late_ticks": self.late_ticks,
            "achieved_rate_hz": self._cadence.rate,
            **self._frames.result(),
            **({"dry_run": True} if self.cfg["dry_run"] else {}),
            **more,
        }
        write_metrics(self.folder, self.command, content)

    def close(self) -> None:
        """Stop the arm, release the devices, end the log."""
        self.bench.close()
        for handler in list(self.log.handlers):
            self.log.removeHandler(handler)
            handler.close()

    def _note(self, sample: Sample) -> None:
        self.steps += 1
        self.late_ticks = self.bench.robot.late_ticks
        self._frames.add(sample.seen)
        self._cadence.add(sample.seen)
        self._sight.add(sample)
        self.robot_time_s = round(sample.applied.time_ns / SECOND + self.bench.robot.period, 9)
        for event in sample.events:
            self.log.info("%.2f s: %s: %s", sample.seen.time, event.kind, event.sentence)

    def _recorder(self, visual_field: VisualField, attached: dict[str, bytes]) -> Recorder:
        settings, seed, robot = self.cfg["recording"], self.cfg["seed"], self.bench.robot
        return Recorder(
            self.folder / "run.mcap",
            body=robot.body,
            field=visual_field,
            period_ns=robot.period_ns,
            metadata=run_record(self.command, seed, self.cfg["robot"]["name"]),
            attachments=attached,
            max_loss=settings["max_loss"],
            reproducible=settings["reproducible"] and not robot.live,
            patience=robot.period if robot.live else None,
        )

    def _attachments(self) -> Iterable[tuple[str, bytes]]:
        yield "config.yaml", OmegaConf.to_yaml(OmegaConf.create(self._without_paths())).encode()
        for key, path in self._inputs.items():
            yield ATTACHED[key], path.read_bytes()
        if urdf := self.cfg["robot"]["arm"].get("urdf"):
            yield Path(urdf).name, find_urdf(urdf).read_bytes()

    def _without_paths(self) -> dict[str, Any]:
        """The configuration with each file that it names told by its content."""
        told = {key: value for key, value in self.cfg.items() if key != "out"}
        told |= {key: _by_content(path) for key, path in self._inputs.items()}
        if film := told["camera"].get("path"):
            content = _by_content(Path(str(film)).expanduser())
            told["camera"] = {**told["camera"], "path": content}
        arm = told["robot"]["arm"]
        if "urdf" in arm and Path(arm["urdf"]).is_file():  # a user's own, else a name of ours
            arm = {**arm, "urdf": _by_content(Path(arm["urdf"]))}
            told["robot"] = {**told["robot"], "arm": arm}
        return told


def _by_content(path: Path) -> str:
    return f"sha256:{sha256(path)}"


def until_interrupted(samples: Iterator[Sample], interruption: Interruption) -> Iterator[Sample]:
    """The steps until a signal asks for the end: a stage that catches it has the last word."""
    for sample in samples:
        yield sample
        if interruption.wanted:
            break
    if interruption.wanted and isinstance(samples, Generator):
        with suppress(KeyboardInterrupt):
            yield samples.throw(KeyboardInterrupt())
            yield from samples


def _log_to(path: Path) -> logging.Logger:
    logging.raiseExceptions = False  # a disk that is full is told by the recorder, once
    log = logging.getLogger(f"imitate.{path.parent}")
    log.setLevel(logging.INFO)
    log.propagate = False
    handler = logging.FileHandler(path)
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(message)s"))
    log.addHandler(handler)
    return log
