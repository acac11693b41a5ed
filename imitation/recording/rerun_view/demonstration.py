"""The demonstration behind a replay, drawn beside it on the replay's clock."""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rerun as rr

from imitation.recording import messages
from imitation.recording.mcap_recording import Recording
from imitation.recording.overview import Overview
from imitation.recording.picture_columns import Batch
from imitation.recording.rerun_view.columns import send
from imitation.recording.rerun_view.look import CYAN, FAINT, image_format, pictures

ENTITY = "demonstration"


@dataclass(frozen=True)
class Demonstration:
    """What was watched, moved in time so that what triggered the replay coincides."""

    recording: Recording
    later_ns: int  # added to its times [ns]

    @classmethod
    def of(cls, run: Path, replayed: Recording) -> "Demonstration":
        """The demonstration recorded in `run`, beside the recording of a replay."""
        recording = Recording.open(run)
        triggers, states = list(_events(replayed, "trigger")), list(_events(recording, "state"))
        if not triggers:
            return cls(recording, 0)
        at, facts = triggers[0]
        state = facts["state"]
        assert isinstance(state, int)
        return cls(recording, at - states[state][0] if state < len(states) else 0)

    def draw(self, stream: rr.RecordingStream, chunks_at_once: int) -> None:
        """Draw what its camera saw."""
        shown = Overview.of(self.recording)
        lines = rr.LineStrips2D(shown.grid.lines, colors=FAINT, radii=0.15)
        stream.log(f"{ENTITY}/areas", lines, static=True)
        stream.log(f"{ENTITY}/hand", rr.Points2D.from_fields(colors=CYAN, radii=1.2), static=True)
        if shown.frame_size:
            look = rr.Image.from_fields(format=image_format(*shown.frame_size, "RGB"))
            stream.log(f"{ENTITY}/image", look, static=True)
        chunks = self.recording.chunks()
        while told := list(itertools.islice(chunks, chunks_at_once)):
            self._draw(stream, Batch(itertools.chain.from_iterable(told), shown.topics))

    def _draw(self, stream: rr.RecordingStream, batch: Batch) -> None:
        if "/camera/image" in batch:
            captured = batch.times("/camera/image") + self.later_ns
            send(stream, f"{ENTITY}/image", captured, pictures(batch))
        places, told = batch.places("/hand") if "/hand" in batch else (np.zeros((0, 2)), [])
        if told:
            points = rr.Points2D.columns(positions=places).partition(told)
            send(stream, f"{ENTITY}/hand", batch.captured() + self.later_ns, points)


def _events(recording: Recording, kind: str) -> Iterator[tuple[int, dict[str, object]]]:
    """When the events of a kind were told [ns], and their facts."""
    for message in itertools.chain.from_iterable(recording.chunks()):
        if message.topic == "/events":
            log = messages.decoded(message.data, messages.LOG)
            if log.name == kind:
                yield message.time_ns, messages.split_log(log)[1]
