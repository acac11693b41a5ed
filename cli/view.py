"""imitate view: look at a recording in Rerun."""

import os
import subprocess
import sys
from pathlib import Path

from cli.errors import DEVICE, DONE, UserError, say
from imitation.recording.rerun_view import derive, screenshot


def view(run: Path, png: Path | None) -> int:
    """Open a run's `run.rrd`, made now if it is missing, or save a picture of it as `png`."""
    rrd = _rrd_of(run)
    if png is None:
        if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
            raise UserError(f"no screen here; type imitate view {run} --screenshot view.png")
        return subprocess.run([sys.executable, "-m", "rerun_cli", str(rrd)], check=False).returncode
    try:
        png.absolute().parent.mkdir(parents=True, exist_ok=True)
        screenshot(rrd, png)
    except RuntimeError as error:
        say(str(error))
        return DEVICE
    return DONE


def _rrd_of(run: Path) -> Path:
    if not run.exists():
        raise UserError(f"no run at {run}; type the folder that `imitate` named at its end")
    if run.suffix == ".rrd":
        return run
    recording = run / "run.mcap" if run.is_dir() else run
    rrd = recording.with_suffix(".rrd")
    if not rrd.exists():
        derive(recording, rrd)
    return rrd
