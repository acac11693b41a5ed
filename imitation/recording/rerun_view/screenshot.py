"""A picture of a Rerun file, without a window."""

import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import IO

from rerun.experimental import ViewerClient

from imitation.recording.rerun_view.panels import TIMELINE
from imitation.robot import SECOND

START = 30.0  # longest wait for the viewer to load the file [s]
SETTLE = 5.0  # until data is fetched and the viewer's greetings have gone [s]
SIZE = "1600x1000"  # of the picture [px]
NO_RENDERER = ("adapter", "wgpu", "render context")  # words of a viewer that has none


def screenshot(rrd: Path, png: Path, at: float | None = None) -> None:
    """Save a picture of `rrd` as it looks `at` seconds of the run's clock; None: at its end.

    Raises:
        ValueError: There is no file `rrd`, or the run was over by then.
        RuntimeError: The viewer cannot start, for lack of a renderer or for another reason.
    """
    if not rrd.is_file():
        raise ValueError(f"no Rerun file at {rrd}")
    port = _free_port()
    command = [sys.executable, "-m", "rerun_cli", str(rrd), "--headless", "--window-size", SIZE]
    with tempfile.TemporaryFile() as told:
        viewer = subprocess.Popen(
            [*command, "--bind", "127.0.0.1", "--port", str(port)],
            stdout=subprocess.DEVNULL,
            stderr=told,
            start_new_session=True,  # so that the viewer behind the launcher can be ended as well
        )
        try:
            client, end = _loaded(viewer, port)
            if at is not None and at > end:
                raise ValueError(f"no picture of {at:g} s: the run ends at {end:.2f} s")
            client.set_time(TIMELINE, duration=end if at is None else at, play_state="paused")
            time.sleep(SETTLE)
            _save(client, png)
        except (ConnectionError, ChildProcessError) as error:
            raise RuntimeError(_why(told)) from error
        finally:
            if viewer.poll() is None:
                os.killpg(viewer.pid, signal.SIGTERM)
            viewer.wait()


def _save(client: ViewerClient, png: Path) -> None:
    try:
        client.save_screenshot(str(png.absolute()))
    except ConnectionError as error:
        told, _, _ = str(error).partition(" (Internal)")
        raise RuntimeError(told) from error


def _loaded(viewer: "subprocess.Popen[bytes]", port: int) -> tuple[ViewerClient, float]:
    """A client of the viewer once it shows the file, and when the run ended [s]."""
    deadline = time.monotonic() + START
    while time.monotonic() < deadline:
        if viewer.poll() is not None:
            raise ChildProcessError("the viewer ended")
        time.sleep(0.1)
        if not listening(port):
            continue
        try:
            client = ViewerClient.connect(f"rerun+http://127.0.0.1:{port}/proxy")
            state = client.get_state()
        except ConnectionError:  # it has just ended, or is not quite there yet
            continue
        ends = [
            timeline.end
            for recording in state.recordings
            for timeline in recording.timelines
            if timeline.name == TIMELINE and timeline.end is not None
        ]
        if state.active_recording and not state.loading and ends:
            return client, max(ends) / SECOND
    raise RuntimeError(f"the Rerun viewer did not show the file within {START:.0f} s")


def listening(port: int) -> bool:
    """Whether someone listens on a port of this machine."""
    with socket.socket() as probe:
        probe.settimeout(0.2)
        return probe.connect_ex(("127.0.0.1", port)) == 0


def _why(told: IO[bytes]) -> str:
    """Why the viewer ended, from its words."""
    told.seek(0)
    words = told.read().decode(errors="replace")
    if any(word in words for word in NO_RENDERER):
        return (
            "a screenshot needs a Vulkan renderer and this machine has none; install a software "
            "one: apt-get install mesa-vulkan-drivers"
        )
    last = words.strip().splitlines()[-1:] or ["without a word"]
    return f"the Rerun viewer ended: {last[0]}"


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
