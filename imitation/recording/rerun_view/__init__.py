"""A recording shown in Rerun, at first sight. The one package that knows Rerun."""

import itertools
from pathlib import Path

import rerun as rr

from imitation.recording.mcap_recording import Recording
from imitation.recording.overview import Overview
from imitation.recording.picture_columns import Batch
from imitation.recording.rerun_view.demonstration import Demonstration
from imitation.recording.rerun_view.drawing import Drawing
from imitation.recording.rerun_view.live import LiveView
from imitation.recording.rerun_view.panels import blueprint
from imitation.recording.rerun_view.saving import saving
from imitation.recording.rerun_view.screenshot import screenshot

__all__ = ["LiveView", "derive", "screenshot"]

CHUNKS_AT_ONCE = 6  # of the recording; more would be faster by little and need more memory


def derive(run: Path, rrd: Path, demonstration: Path | None = None) -> None:
    """Write the Rerun file of a recording.

    Args:
        run: A run folder or its `run.mcap`; may be cut.
        rrd: Where to write; replaced if it exists.
        demonstration: The run that a replay reproduces, to be shown beside it.

    Raises:
        ValueError: There is no recording at `run`, it is damaged, or it holds no step.
        OSError: `rrd` cannot be written.
    """
    recording = Recording.open(run)
    unfinished = rrd.with_name(f".{rrd.name}")  # one that was interrupted must not be shown
    try:
        _draw(recording, unfinished, demonstration)
        unfinished.replace(rrd)
    except OSError as error:
        if error.filename == str(unfinished):
            error.filename = str(rrd)
        raise
    finally:
        unfinished.unlink(missing_ok=True)


def _draw(recording: Recording, rrd: Path, demonstration: Path | None) -> None:
    shown = Overview.of(recording)
    stream = rr.RecordingStream("imitation", send_properties=False)
    with saving(stream, rrd, blueprint(shown, demonstration is not None)):
        drawing = Drawing(shown)
        drawing.draw_constants(stream)
        if demonstration is not None:
            Demonstration.of(demonstration, recording).draw(stream, CHUNKS_AT_ONCE)
        chunks = recording.chunks()
        while told := list(itertools.islice(chunks, CHUNKS_AT_ONCE)):
            drawing.draw(stream, Batch(itertools.chain.from_iterable(told), recording.topics))
