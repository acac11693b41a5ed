"""imitate verify: every logged decision is made anew from the logged senses, and compared."""

import os
import shlex
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from omegaconf import OmegaConf
from rich.box import SIMPLE_HEAD
from rich.table import Table

from cli.errors import DONE, NOT_TRUE, UserError, say
from cli.folder import check_writable
from cli.inspect import results
from cli.printed import as_it_stands, facts, on_stdout
from cli.provenance import another_program
from cli.recompute import Anew, anew, configuration
from cli.what_if import replaced
from imitation.analysis.comparison import Comparison, Difference
from imitation.analysis.seal import Break, broken, cited
from imitation.analysis.step_table import unit_of
from imitation.recording.mcap_form import otherwise_written
from imitation.recording.mcap_recording import Recording
from imitation.recording.recorded_steps import StepTold
from imitation.recording.recorder import Recorder
from imitation.recording.run_files import free
from imitation.recording.step_messages import StepMessages
from imitation.robot import SECOND
from imitation.sample import Sample

WIDEST = 16  # of a value in a table [letters]

Pairs = Iterable[tuple[StepTold | None, Sample | None]]


def verify(run: Path, asked: Sequence[str] = (), more: Sequence[str] = ()) -> int:
    """As recorded, or with other parameters: `--with` takes one, and more may follow it."""
    if more and not asked:
        raise UserError(f"'{more[0]}' wants --with before it; type --with {' '.join(more)}")
    return what_if(run, [*asked, *more]) if asked else as_recorded(run)


def as_recorded(run: Path) -> int:
    """Compare a recording with what is decided anew; the exit code."""
    recording = Recording.open(run)
    breaks, found = broken(recording), Comparison(recording.topics)
    stopped = otherwise = ""
    try:
        if "/camera/used" in recording.topics:  # else it was killed before its first step
            with anew(recording) as decided:
                compare(found, decided, decided.paired())
                if not breaks:
                    robot = decided.bench.robot
                    otherwise = otherwise_written(recording, robot.body, decided.field)
    except Exception as error:
        if not breaks or not recording.digest():
            raise
        stopped = str(error)  # whatever a changed recording leads to
    told = [("steps", f"{found.steps} decided anew")]
    told += [("digest", f"{cited(recording.digest())}  {_seal(breaks)}")]
    told += [("decisions", _differing(found) if found.differing else "the same, bit for bit")]
    by = another_program(recording.metadata["run"])
    told += [("program", f"another: {by}")] if by else []
    show("imitate verify", told, found)
    complaints = [one.sentence for one in breaks]
    complaints += [f"recomputing ended: {stopped}"] if stopped else []
    complaints += [otherwise] if otherwise else []
    complaints += [] if complaints else _counted(recording, found.steps)
    complaints += [found.first.sentence] if found.first else []
    complaints += [f"what differs may be the program: {by}"] if found.first and by else []
    for complaint in complaints:
        say(complaint)
    return NOT_TRUE if complaints else DONE


def _counted(recording: Recording, steps: int) -> list[str]:
    """A complaint when a run that came to its end tells of more or fewer steps than there are."""
    metrics = results(recording.path.parent) if recording.path.name == "run.mcap" else {}
    told = metrics.get("steps", steps)
    if metrics.get("status") != "done" or told == steps:
        return []
    return [
        f"metrics.json tells of {told} steps, {recording.path.name} of {steps}: one was changed"
    ]


def what_if(run: Path, words: Sequence[str]) -> int:
    """Decide anew with other parameters, record it, say what would differ; 1 if anything does."""
    recording = Recording.open(run)
    found = Comparison(recording.topics)
    with anew(recording, words) as decided, _whole(recording, decided, words) as second:
        compare(found, decided, _recorded_too(decided.paired(), second))
    told = [("steps", f"{found.steps} decided anew")]
    told += [("decisions", _differing(found) if found.differing else "the same, bit for bit")]
    show(f"what if: {' '.join(words)}", told, found)
    path = second.path
    console = on_stdout()
    console.print(f"files  {path}", markup=False)
    console.print(f"next   imitate view {shlex.quote(os.path.relpath(path))}", markup=False)
    return NOT_TRUE if found.differing else DONE


def compare(found: Comparison, decided: Anew, pairs: Pairs) -> None:
    """Compare every step with what is decided anew."""
    steps = StepMessages(decided.bench.robot.body)
    for told, sample in pairs:
        if told is None or sample is None:
            found.note(_one_sided(told, sample))
        else:
            found.add(told.messages, list(steps.of(sample, ())))


def _one_sided(told: StepTold | None, sample: Sample | None) -> Difference:
    goes_on, over = "goes on", "is over"
    if told is not None:
        return Difference(told.time_ns, "steps", "episode", goes_on, over, float("inf"))
    assert sample is not None
    return Difference(sample.seen.time_ns, "steps", "episode", over, goes_on, float("inf"))


def _recorded_too(pairs: Pairs, second: Recorder) -> Pairs:
    for told, sample in pairs:
        if told is not None and sample is not None:
            second.write(sample, ())
        yield told, sample


@contextmanager
def _whole(recording: Recording, decided: Anew, words: Sequence[str]) -> Iterator[Recorder]:
    """A recording beside the first one, which is gone when anything interrupts it."""
    path = free(recording.path.with_name("what-if.mcap"))
    check_writable(path, "copy the run to a folder of your own")
    try:
        with _second(path, recording, decided, words) as second:
            yield second
    except BaseException:
        path.unlink(missing_ok=True)
        raise


def _second(path: Path, recording: Recording, decided: Anew, words: Sequence[str]) -> Recorder:
    command, recorded = recording.metadata["run"]["command"], configuration(recording)
    text = OmegaConf.to_yaml(OmegaConf.create(dict(replaced(command, recorded, words))))
    return Recorder(
        path,
        body=decided.bench.robot.body,
        field=decided.field,
        period_ns=decided.bench.period_ns,
        metadata=recording.metadata["run"] | {"what_if": " ".join(words)},
        attachments=recording.attachments | {"config.yaml": text.encode()},
        max_loss=decided.bench.cfg["recording"]["max_loss"],
        reproducible=True,
    )


def show(title: str, told: Sequence[tuple[str, str]], found: Comparison) -> None:
    """Print what came out, and what differs on each topic."""
    console = on_stdout()
    console.print(facts(title, told))
    if not found.differing:
        return
    table = Table(title="what differs", title_justify="left", box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
    table.add_column("topic", no_wrap=True)
    for heading in ("steps", "first at", "recorded", "anew", "most"):
        table.add_column(heading, justify="right")
    for topic, one in found.differing.items():
        first, unit = one.first, unit_of(topic, one.first.term)
        most = f"{one.largest:.2g} {unit}".strip() if np.isfinite(one.largest) else ""
        values = (_short(first.recorded), _short(first.recomputed))
        since = f"{first.time_ns / SECOND:.2f} s"
        table.add_row(*as_it_stands((topic, str(one.steps), since, *values, most)))
    console.print(table)


def _short(value: str) -> str:
    try:
        return f"{float(value):.4g}"
    except ValueError:
        return value if len(value) <= WIDEST else f"{value[: WIDEST - 3]}..."


def _differing(found: Comparison) -> str:
    return f"differ on {len(found.differing)} topics"


def _seal(breaks: Sequence[Break]) -> str:
    return "does not match the content" if breaks else "matches the content"
