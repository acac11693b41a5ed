"""A recording as a film: what the camera saw, with the areas, the hand and the target on it."""

import errno
import os
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np

from imitation.arrays import Array, Image
from imitation.recording import messages
from imitation.recording.mcap_recording import Recording
from imitation.recording.overview import Grid
from imitation.recording.recorded_steps import StepTold, steps_told
from imitation.robot import SECOND

# OpenCV and FFmpeg have words of their own for what we say in one line.
os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
LARGER = 4  # the picture is shown this much larger, so that marks have room
CODEC = "vp09"  # browsers show it, and it needs no library that is not here
FAINT, CYAN, YELLOW, WHITE = (120, 120, 120), (0, 220, 255), (255, 220, 0), (255, 255, 255)
MARKS = {"/hand": (CYAN, 5, -1), "/target": (YELLOW, 7, -1), "/truth/hand": (WHITE, 10, 1)}


def write_video(path: Path, recording: Recording, period_ns: int) -> None:
    """Write a film at the rate of the control steps, on the run's own clock.

    Raises:
        ValueError: The recording is damaged or holds no step.
        OSError: The film cannot be written.
    """
    writer: cv2.VideoWriter | None = None
    count = 0
    try:
        for picture in pictures(recording, period_ns):
            if writer is None:
                height, width, _ = picture.shape
                code = cv2.VideoWriter.fourcc(*CODEC)
                writer = cv2.VideoWriter(str(path), code, SECOND / period_ns, (width, height))
                if not writer.isOpened():
                    raise OSError(errno.EIO, "no film can be begun there", str(path))
            writer.write(cv2.cvtColor(picture, cv2.COLOR_RGB2BGR))
            count += 1
    finally:
        if writer is not None:
            writer.release()
    if writer is None:
        raise ValueError(f"{recording.path} holds no step: there is nothing to show")
    if cv2.VideoCapture(str(path)).get(cv2.CAP_PROP_FRAME_COUNT) != count:  # OpenCV does not tell
        raise OSError(errno.EIO, "not every picture was written, the disk may be full", str(path))


def pictures(recording: Recording, period_ns: int) -> Iterator[Image]:
    """A picture for each period from the run's start; where no step was, the last one lasts."""
    grid, due_ns, last = Grid.of(recording), 0, None
    for told in steps_told(recording):
        while last is not None and due_ns + period_ns // 2 < told.time_ns:
            yield last
            due_ns += period_ns
        last = drawn(told, grid)
        yield last
        due_ns = max(due_ns, told.time_ns) + period_ns


def drawn(told: StepTold, grid: Grid) -> Image:
    """The frame of a step, larger and with its marks."""
    frame = told.step.seen.frame
    height, width, _ = frame.shape
    picture = cv2.resize(frame, (LARGER * width, LARGER * height), interpolation=cv2.INTER_NEAREST)
    for line in grid.lines:
        start, end = ((round(LARGER * x), round(LARGER * y)) for x, y in line)
        cv2.line(picture, start, end, FAINT, 1)
    for topic, (colour, radius, thickness) in MARKS.items():
        place = _place(told, topic)
        if place is not None:
            x, y = (round(LARGER * float(part)) for part in place)
            cv2.circle(picture, (x, y), radius, colour, thickness, cv2.LINE_AA)
    time = f"{told.time_ns / SECOND:.2f} s"
    cv2.putText(picture, time, (8, 20), cv2.FONT_HERSHEY_SIMPLEX, 0.55, WHITE, 1, cv2.LINE_AA)
    return np.asarray(picture, dtype=np.uint8)


def _place(told: StepTold, topic: str) -> Array | None:
    for message in told.messages:
        if message.topic == topic:
            point = messages.decoded(message.data, messages.POINT).point
            place = np.array((point.x, point.y))
            return place if np.isfinite(place).all() and np.all(np.abs(place) < 1e4) else None
    return None
