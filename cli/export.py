"""imitate export: recordings as tables, as a film or as a LeRobot dataset."""

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
from imitation.recording.run_files import write_whole
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
    out.absolute().parent.mkdir(parents=True, exist_ok=True)
    check_writable(out, "name another OUT")
    with at_work(f"writing {out}"):
        write_whole(out, lambda unfinished: KINDS[kind](unfinished, recordings))
    total = sum(path.stat().st_size for path in (out, *out.rglob("*")) if path.is_file())
    on_stdout().print(f"files  {out}  {size(total)}", markup=False)
    return DONE


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
