"""Columns of a Rerun recording on the run's own clock."""

from typing import Any

import rerun as rr

from imitation.recording.picture_columns import Times
from imitation.recording.rerun_view.panels import TIMELINE


def send(stream: rr.RecordingStream, entity: str, times_ns: Times, columns: Any) -> None:
    """Send the columns of an entity on the run's own clock."""
    clock = rr.TimeColumn(TIMELINE, duration=times_ns.astype("timedelta64[ns]"))
    rr.send_columns(entity, [clock], columns, recording=stream)
