"""imitate view: look at a recording in Rerun."""

import os
import subprocess
import sys
from pathlib import Path

from cli.errors import DEVICE, DONE, UserError, say
from cli.folder import check_writable
from cli.printed import on_stdout
from cli.progress import at_work
from imitation.recording.run_files import file_in, next_free
from imitation.recording.yaml_reading import read_yaml

PICTURES = (".png", ".jpg", ".jpeg")


def view(run: Path, png: Path | None, at: float | None) -> int:
    """Open a run's `run.rrd`, made now if it is missing, or save a picture of it as `png`."""
    if at is not None and (png is None or not at >= 0):
        raise UserError(f"--at {at:g}: type --screenshot FILE --at SECONDS, 0 or later")
    rrd = rrd_of(run)
    if png is None:
        if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
            raise UserError(f"no screen here; type imitate view {run} --screenshot view.png")
        viewer = [sys.executable, "-m", "rerun_cli", str(rrd)]
        return subprocess.run(viewer, check=False).returncode
    if png.suffix.lower() not in PICTURES:
        raise UserError(f"--screenshot {png}: wanted a name that ends in {', '.join(PICTURES)}")
    if png.exists():
        raise UserError(
            f"{png} is there already and nothing is written over; type --screenshot "
            f"{next_free(png)}"
        )
    try:
        png.absolute().parent.mkdir(parents=True, exist_ok=True)
        check_writable(png, "name another file")
        from imitation.recording.rerun_view import screenshot

        screenshot(rrd, png, at)
    except RuntimeError as error:
        say(str(error))
        return DEVICE
    on_stdout().print(f"files  {png}", markup=False)
    return DONE


def rrd_of(run: Path) -> Path:
    """The Rerun file of a run, made now if it is missing."""
    if not run.exists():
        raise UserError(f"no run at {run}; type the folder that `imitate` named at its end")
    if run.suffix == ".rrd":
        return run
    recording = file_in(run, "run.mcap")
    rrd = recording.with_suffix(".rrd")
    if not rrd.exists():
        check_writable(rrd, "copy the run to a folder of your own")
        derive_rrd(recording, rrd)
    return rrd


def derive_rrd(recording: Path, rrd: Path) -> None:
    """Derive the Rerun file of a recording."""
    os.environ.setdefault("RUST_LOG", "error")  # Rerun warns of meshes it does not find
    from imitation.recording.rerun_view import derive  # takes a second

    with at_work(f"making {rrd}"):
        derive(recording, rrd, demonstration_of(recording.parent))


def demonstration_of(run: Path) -> Path | None:
    """The recording of the demonstration that a run replays, if it lies where it was."""
    config = run / "config.yaml"
    try:
        told = read_yaml(config.read_bytes())
    except (OSError, ValueError):  # it is not needed for what is shown
        return None
    action = told.get("action") if isinstance(told, dict) else None
    if not isinstance(action, str):
        return None
    named = Path(action).expanduser()
    recording = (named if named.is_dir() else named.parent) / "run.mcap"
    return recording if recording.is_file() else None
