"""Shows a run in a Rerun viewer while it goes on; never slows it down."""

import threading
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import replace

import rerun as rr

from imitation.recording.overview import Overview
from imitation.recording.picture_columns import Batch
from imitation.recording.rerun_view.drawing import Drawing
from imitation.recording.rerun_view.panels import blueprint
from imitation.recording.rerun_view.screenshot import listening
from imitation.recording.step_messages import StepMessages
from imitation.robot import Body, Truth
from imitation.sample import Event, Sample
from imitation.visual_field import VisualField

PAUSE = 0.1  # between two pictures [s]
MOST_EVENTS = 100  # kept between two pictures
FAREWELL = 2.0  # longest wait for the viewer at the end [s]


class LiveView:
    """Shows the newest step ten times a second; steps in between are dropped, events are not.

    Args:
        body: The arm.
        field: The visual field.
        attachments: Files that belong to the run, by name.
        port: Of the viewer on this machine.

    Raises:
        ValueError: No viewer listens on `port`.
    """

    def __init__(
        self, body: Body, field: VisualField, attachments: Mapping[str, bytes], port: int = 9876
    ) -> None:
        if not listening(port):
            raise ValueError(
                f"recording.live=true needs a Rerun viewer on port {port} of this machine; "
                f"start one with: rerun --bind 127.0.0.1 --port {port}"
            )
        self._body, self._field, self._attachments = body, field, dict(attachments)
        self._url = f"rerun+http://127.0.0.1:{port}/proxy"
        self._newest: tuple[Sample, Sequence[Truth]] | None = None
        self._events: deque[Event] = deque(maxlen=MOST_EVENTS)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="live view", daemon=True)
        self._thread.start()

    def show(self, sample: Sample, truths: Sequence[Truth]) -> None:
        """Show one step, unless a newer one comes before it is drawn."""
        self._events.extend(sample.events)
        self._newest = sample, truths

    def close(self) -> None:
        """Let go of the viewer; harmless when repeated."""
        self._ended.set()
        self._thread.join(FAREWELL)

    def _run(self) -> None:
        drawing: Drawing | None = None
        stream = rr.RecordingStream("imitation", send_properties=False)
        steps = StepMessages(self._body)
        while not self._ended.wait(PAUSE):
            newest, self._newest = self._newest, None
            if newest is None:
                continue
            sample, truths = newest
            shown = Overview.of_live(self._body, self._field, self._attachments, sample)
            if drawing is None:
                drawing = Drawing(shown)
                stream.connect_grpc(self._url, default_blueprint=blueprint(shown))
                drawing.draw_constants(stream)
            events = tuple(self._events.popleft() for _ in range(len(self._events)))
            told = steps.of(replace(sample, events=events), truths)
            drawing.draw(stream, Batch(told, shown.topics))
        stream.disconnect()
