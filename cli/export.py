"""imitate export: recordings as tables, as a film or as a LeRobot dataset."""

import os
import re
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path

from cli.errors import DONE, UserError, no_such
from cli.folder import check_writable
from cli.inspect import size
from cli.printed import on_stdout
from cli.progress import at_work
from cli.recompute import configuration
from imitation.analysis.lerobot import Dataset
from imitation.analysis.seal import cited
from imitation.analysis.step_table import Column, table
from imitation.analysis.table_files import joined, write_csv, write_parquet
from imitation.analysis.video import write_video
from imitation.recording.mcap_recording import Recording
from imitation.robot import SECOND

Write = Callable[[Path, Sequence[Recording]], None]


def export(paths: Sequence[Path], kind: str) -> int:
    """Write runs, all `paths` but the last, as `kind` to the last of them; the exit code."""
    if kind not in KINDS:
        raise UserError(f"--to {kind}: {no_such('format', kind, list(KINDS))}")
    if len(paths) < 2:
        raise UserError("a run and OUT are needed; type imitate export RUN --to csv OUT")
    *runs, out = paths
    if out.exists():
        raise UserError(f"{out} is there already and nothing is written over; name another OUT")
    if kind == "video" and out.suffix != ".mp4":
        raise UserError(f"{out}: a video is written as .mp4; type {out.with_suffix('.mp4')}")
    recordings = [Recording.open(run) for run in runs]
    empty = [one.path for one in recordings if "/camera/used" not in one.topics]
    if empty:
        raise UserError(f"{empty[0]} holds no step: there is nothing to export")
    write_whole(out, lambda unfinished: KINDS[kind](unfinished, recordings))
    total = sum(path.stat().st_size for path in (out, *out.rglob("*")) if path.is_file())
    on_stdout().print(f"files  {out}  {size(total)}", markup=False)
    return DONE


def write_whole(out: Path, write: Callable[[Path], None]) -> None:
    """Have `out` written beside itself, and put in its place when all of it is there."""
    out.absolute().parent.mkdir(parents=True, exist_ok=True)
    check_writable(out, "name another OUT")
    _clear_what_was_killed(out)
    unfinished = out.with_name(f".{out.stem}-{os.getpid()}{out.suffix}")
    try:
        with at_work(f"writing {out}"):
            write(unfinished)
        unfinished.rename(out)
    except OSError as error:
        error.filename = str(out)  # what was asked for, not the hidden one
        raise
    finally:
        _remove(unfinished)


def _clear_what_was_killed(out: Path) -> None:
    """Remove what exports to `out` left when they were killed."""
    for left in out.absolute().parent.iterdir():
        found = re.fullmatch(rf"\.{re.escape(out.stem)}-(\d+){re.escape(out.suffix)}", left.name)
        if found and not Path("/proc", found[1]).exists():
            _remove(left)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path)
    path.unlink(missing_ok=True)


def _csv(out: Path, recordings: Sequence[Recording]) -> None:
    write_csv(out, _tables(recordings))


def _parquet(out: Path, recordings: Sequence[Recording]) -> None:
    digests = " · ".join(cited(one.digest()) for one in recordings)
    facts = {"made by": "imitate export", "digests of the runs": digests}
    write_parquet(out, _tables(recordings), facts)


def _tables(recordings: Sequence[Recording]) -> dict[str, Column]:
    return joined({_name(one): table(one) for one in recordings})


def _video(out: Path, recordings: Sequence[Recording]) -> None:
    if len(recordings) > 1:
        raise UserError("--to video takes one run; type a command for each")
    write_video(out, recordings[0], _period_ns(recordings[0]))


def _lerobot(out: Path, recordings: Sequence[Recording]) -> None:
    first = recordings[0]
    out.mkdir()
    robot = first.metadata["run"].get("robot", "")
    dataset = Dataset(out, _period_ns(first), robot, first.topics["/joint_states"].names)
    for recording in recordings:
        other = recording.metadata["run"].get("robot", "")
        if other != robot:
            raise UserError(
                f"{recording.path} is of robot={other}, {first.path} of robot={robot}: "
                "a LeRobot dataset is of one robot; export each to its own OUT"
            )
        if _period_ns(recording) != _period_ns(first):
            raise UserError(f"{recording.path} has another control period than {first.path}")
        dataset.add(recording)
    dataset.finish()


def _period_ns(recording: Recording) -> int:
    return round(float(configuration(recording)["period"]) * SECOND)


def _name(recording: Recording) -> str:
    path = recording.path
    return path.absolute().parent.name if path.name == "run.mcap" else path.stem


KINDS: dict[str, Write] = {
    "csv": _csv,
    "parquet": _parquet,
    "video": _video,
    "lerobot": _lerobot,
}
