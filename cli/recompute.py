"""A recorded run decided on anew: the same stage, on a robot that senses what was recorded."""

import hashlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import tee
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from omegaconf import OmegaConf

from cli import stages
from cli.build import Bench, Config
from cli.check import checked
from cli.config_dir import not_known, values
from cli.errors import UserError, is_refusal, no_such
from cli.jobs.reach import trials_of
from cli.keys import known_targets
from cli.progress import at_work
from cli.provenance import another_program, its_program
from cli.replaying import replaying
from cli.run import ATTACHED
from cli.usual import filled
from cli.what_if import replaced
from imitation.recording.action_file import load_action
from imitation.recording.map_file import LearnedMap, load_map
from imitation.recording.mcap_recording import Recording
from imitation.recording.recorded_steps import StepTold, steps_told
from imitation.recording.yaml_reading import read_yaml
from imitation.robots.recorded import Unrecorded
from imitation.sample import Sample
from imitation.visual_field import VisualField

Staged = tuple[VisualField, Iterator[Sample]]
HASHED = "sha256:"  # stands before the digest of a file that the configuration names


@dataclass(frozen=True)
class Anew:
    """A recorded run, and the same decided on anew."""

    bench: Bench
    field: VisualField
    told: Iterator[StepTold]
    samples: Iterator[Sample]

    def paired(self) -> Iterator[tuple[StepTold | None, Sample | None]]:
        """Each recorded step with what was decided anew, up to where the recording ends.

        One of the two is None where the stage now ends an episode earlier or later.
        """
        waiting = next(self.told, None)
        for sample in self.samples:
            if waiting is None:
                return
            if isinstance(sample.seen, Unrecorded):
                yield None, sample
                continue
            while waiting is not None and waiting.step.seen is not sample.seen:
                yield waiting, None
                waiting = next(self.told, None)
            yield waiting, sample
            waiting = next(self.told, None)
        while waiting is not None:
            yield waiting, None
            waiting = next(self.told, None)


@contextmanager
def anew(recording: Recording, words: Sequence[str] = ()) -> Iterator[Anew]:
    """Decide anew on what a recording tells.

    Args:
        recording: Of any stage.
        words: KEY=VALUE words that change its configuration.

    Raises:
        UserError: It cannot be recomputed; the message says why.
    """
    command = recording.metadata["run"].get("command", "")
    if command not in STAGES:
        raise UserError(f"{recording.path}: {no_such('stage', command, sorted(STAGES))}")
    what = f"{recording.path.absolute().parent.name}: deciding anew"
    with TemporaryDirectory() as folder, at_work(what):
        cfg = _understood(recording, command, words, Path(folder))
        bench = Bench(cfg)
        told, fed = tee(steps_told(recording))
        bench.relive(one.step for one in fed)
        field, samples = STAGES[command](bench)
        yield Anew(bench, field, told, bench.watched(samples))


def _stored(bench: Bench) -> LearnedMap:
    return load_map(Path(bench.cfg["map"]))


def _understood(recording: Recording, command: str, words: Sequence[str], folder: Path) -> Config:
    """The configuration of a run, changed by `words`, with its inputs in `folder`."""
    try:
        recorded = filled(command, _unpacked(recording, folder))
        checked(command, OmegaConf.create(dict(recorded)))
    except (UserError, ValueError, AttributeError, LookupError, TypeError) as error:
        by = another_program(recording.metadata["run"])
        if is_refusal(error) and not by:
            raise
        todo = f": {by}; type {its_program(recording.metadata['run'])} first" if by else ""
        raise UserError(
            f"{recording.path} cannot be recomputed, its configuration is not understood "
            f"({error}){todo}"
        ) from error
    return checked(command, OmegaConf.create(dict(replaced(command, recorded, words))))


def _learning(bench: Bench) -> Staged:
    _, samples = stages.learning(bench)
    return bench.field, samples


def _reaching(bench: Bench) -> Staged:
    stored = _stored(bench)
    return stored.map.field, stages.reaching(bench, stored.map, trials_of(bench, stored))


def _checking(bench: Bench) -> Staged:
    learned = _stored(bench).map
    _, samples = stages.checking(bench, learned)
    return learned.field, samples


def _mimicking(bench: Bench) -> Staged:
    learned = _stored(bench).map
    stage = stages.drawing if bench.cfg["mirror"] else stages.mimicking
    return learned.field, stage(bench, learned)


def _watching(bench: Bench) -> Staged:
    _, samples = stages.watching(bench)
    return bench.field, samples


def _replaying(bench: Bench) -> Staged:
    learned, cells = _stored(bench).map, bench.cfg["sequence"]["cells"]
    action = load_action(Path(bench.cfg["action"]), cells["shortest"], cells["longest"])
    _, samples = replaying(bench, learned, action)
    return learned.field, samples


STAGES: Mapping[str, Callable[[Bench], Staged]] = {
    "learn-map": _learning,
    "reach": _reaching,
    "check-map": _checking,
    "mimic": _mimicking,
    "demo-record": _watching,
    "replay": _replaying,
}


def configuration(recording: Recording) -> dict[str, Any]:
    """The configuration that a run was given, as its recording tells it.

    Raises:
        UserError: There is none, or it is damaged.
    """
    try:
        cfg = read_yaml(recording.attachments["config.yaml"])
    except (KeyError, ValueError):
        cfg = None
    if not isinstance(cfg, dict):
        raise UserError(f"{recording.path} holds no configuration: it cannot be recomputed")
    return cfg


def _unpacked(recording: Recording, folder: Path) -> Config:
    """The configuration with the files that it names written into `folder`."""
    cfg = configuration(recording)
    for target in values("_target_", cfg):
        if target not in known_targets():  # nothing named in a file is called unless we know it
            raise UserError(f"{recording.path}: {not_known(target)}")
    files = {hashlib.sha256(data).hexdigest(): data for data in recording.attachments.values()}
    for key, value in cfg.items():
        if key in ATTACHED and str(value).startswith(HASHED):
            data = files.get(value.removeprefix(HASHED))
            if data is None:
                raise UserError(f"{recording.path}: the file of {key}= is missing or was changed")
            path = folder / ATTACHED[key]
            path.write_bytes(data)
            cfg[key] = str(path)
    models = [data for name, data in recording.attachments.items() if name.endswith(".urdf")]
    robot = cfg.get("robot")
    arm = robot.get("arm") if isinstance(robot, dict) else None
    if models and isinstance(arm, dict) and "urdf" in arm:
        (folder / "arm.urdf").write_bytes(models[0])
        arm["urdf"] = str(folder / "arm.urdf")
    return {"out": None, **cfg}
