"""imitate recover: the recording of a killed run made whole again."""

import fcntl
import os
import shlex
from pathlib import Path

from rich.console import Console

from cli.errors import DONE, UserError
from cli.folder import check_writable
from cli.inspect import results, size
from cli.metrics_file import write_metrics
from cli.printed import facts, on_stdout
from cli.recompute import configuration
from imitation.recording.mcap_reading import is_whole
from imitation.recording.mcap_recording import Recording, recording_in
from imitation.recording.mcap_recover import Recovery, recover
from imitation.robot import SECOND


def recover_run(run: Path) -> int:
    """Recover a run's recording, write its metrics.json; the exit code."""
    path = recording_in(run)
    console = on_stdout()
    if is_good(path):
        console.print(f"{path} is whole: there is nothing to recover", markup=False)
        return DONE
    refuse_while_written(path)
    check_writable(path, "copy the run to a folder of your own")
    recovery, kept = recover(path)
    if path.name == "run.mcap":
        tell(Recording.open(path), recovery)
    show(console, run, recovery, kept)
    return DONE


def is_good(path: Path) -> bool:
    """Whether a recording is whole and nothing in it is damaged."""
    if not is_whole(path):
        return False
    try:
        for _ in Recording.open(path).chunks():
            pass
    except ValueError:
        return False
    return True


def refuse_while_written(path: Path) -> None:
    """Raise an error when a run still writes its recording."""
    with path.open("rb") as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise UserError(f"{path} is still being written; wait for the run's end") from None


def tell(recording: Recording, recovery: Recovery) -> None:
    """Write metrics.json; what a run that failed told there before stays in it."""
    told, folder = recording.metadata["run"], recording.path.parent
    period = float(configuration(recording).get("period", 0.0))
    content = {
        "command": told.get("command"),
        "seed": int(told.get("seed", 0)),
        "wall_time_s": None,
        **results(folder),
        "status": "truncated",
        "steps": recovery.steps,
        "robot_time_s": round(recovery.last_ns / SECOND + period, 9) if recovery.steps else 0.0,
    }
    write_metrics(folder, str(told.get("command")), content)


def show(console: Console, run: Path, recovery: Recovery, kept: Path) -> None:
    """Print what was kept."""
    until = f"until {recovery.last_ns / SECOND:.2f} s" if recovery.steps else "none"
    told = [("steps", f"{recovery.steps}, {until}")]
    told += [("damage", recovery.damage)] if recovery.damage else []
    told += [("the cut one", f"{os.path.relpath(kept)}, {size(kept.stat().st_size)}")]
    console.print(facts("imitate recover", told))
    console.print(f"next   imitate verify {shlex.quote(str(run))}", markup=False)
