"""The steps of a recording: what was sensed at each, and all that was said of it."""

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from imitation.arrays import Image
from imitation.guard import REASONS
from imitation.jpeg import decoded
from imitation.recording import messages
from imitation.recording.mcap_recording import Recording
from imitation.recording.step_messages import Message, Topic
from imitation.robot import SECOND, Observation, Shot
from imitation.sample import RecordedStep

SENSES = {
    "/camera/used": messages.HEADER,
    "/joint_states": messages.JOINT_STATE,
    "/gaze": messages.FLOATS,
    "/gripper": messages.FLOATS,
    "/hand/noise": messages.POINT,
    "/joint_command/sent": messages.JOINT_STATE,
}
NEEDED = set(SENSES) - {"/hand/noise"}


@dataclass(frozen=True)
class StepTold:
    """One step as it stands in a recording."""

    step: RecordedStep
    messages: Sequence[Message]

    @property
    def time_ns(self) -> int:
        """When it was decided on [ns]."""
        return self.step.seen.time_ns


def steps_told(recording: Recording) -> Iterator[StepTold]:
    """Every step of a recording, in order.

    Raises:
        ValueError: The file is damaged, or a step lacks a sense.
    """
    frames, trouble = Frames(recording.topics), None
    for number, said in enumerate(grouped(recording.chunks())):
        begins = number == 0
        for event in events(said):
            begins = begins or event.name == "episode"
            if event.name == "limited":
                trouble = _trouble(event)
        yield StepTold(_step(said, frames, begins, trouble), said)


def events(said: Sequence[Message]) -> Iterator[Any]:
    """The events among messages."""
    for message in said:
        if message.topic == "/events":
            yield messages.decoded(message.data, messages.LOG)


def _trouble(limited: Any) -> str | None:
    """Why the arm was not to move, when it is nothing that the guard finds by itself."""
    _, facts = messages.split_log(limited)
    return next((reason for reason in facts["reasons"] if reason not in REASONS), None)


def grouped(chunks: Iterable[Sequence[Message]]) -> Iterator[list[Message]]:
    """The messages of each step: its frames come first, then the time of the frame it used."""
    said: list[Message] = []
    for message in itertools.chain.from_iterable(chunks):
        starts = message.topic in ("/camera/image", "/camera/used")
        if starts and said and said[-1].topic != "/camera/image":
            yield said
            said = []
        said.append(message)
    if said:
        yield said


class Frames:
    """The frames that may still be decided on.

    Args:
        topics: Of the recording.
    """

    def __init__(self, topics: dict[str, Topic]) -> None:
        self._topics = topics
        self._waiting: dict[int, bytes] = {}
        self._shown: tuple[int, Image, bytes | None] | None = None

    def add(self, message: Message) -> None:
        """One more frame came."""
        self._waiting[message.time_ns] = message.data

    def captured_at(self, time_ns: int) -> tuple[Image, bytes | None]:
        """A frame, and the JPEG it was decoded from; older ones are let go.

        Raises:
            ValueError: It is not in the recording.
        """
        if self._shown is None or self._shown[0] != time_ns:
            if time_ns not in self._waiting:
                raise ValueError(f"the frame captured at {time_ns / SECOND:.3f} s is not recorded")
            told = messages.decoded(self._waiting[time_ns], self._topics["/camera/image"].type)
            self._shown = (time_ns, *picture(told))
            self._waiting = {at: told for at, told in self._waiting.items() if at > time_ns}
        return self._shown[1:]


def picture(told: Any) -> tuple[Image, bytes | None]:
    """The frame of an `Image` or a `CompressedImage`, RGB, and the JPEG of the latter.

    Raises:
        ValueError: It is no picture.
    """
    if told.__msgtype__ == messages.IMAGE:
        if told.data.size != told.height * told.width * 3:
            raise ValueError(f"a frame of {told.width}x{told.height} px is damaged")
        return told.data.reshape(told.height, told.width, 3), None
    jpeg = told.data.tobytes()
    return decoded(jpeg), jpeg


def _step(
    said: Sequence[Message], frames: Frames, begins: bool, trouble: str | None
) -> RecordedStep:
    told: dict[str, Any] = {}
    came = []  # when the frames of this step were captured [ns]
    for message in said:
        if message.topic == "/camera/image":
            frames.add(message)
            came.append(message.time_ns)
        elif message.topic in SENSES:
            told[message.topic] = messages.decoded(message.data, SENSES[message.topic])
    if missing := NEEDED - told.keys():
        at = said[-1].time_ns / SECOND
        raise ValueError(f"the step at {at:.3f} s lacks {', '.join(sorted(missing))}")
    sent = told["/joint_command/sent"]
    seen, sent_ns = _observation(told, frames, came, begins), messages.time_of(sent.header)
    return RecordedStep(seen, sent.velocity, sent_ns, begins, trouble)


def _observation(
    told: dict[str, Any], frames: Frames, came: Sequence[int], begins: bool
) -> Observation:
    joints, used, noise = told["/joint_states"], told["/camera/used"], told.get("/hand/noise")
    captured = messages.time_of(used)
    skipped = [(at, *frames.captured_at(at)) for at in came if at != captured]
    frame, jpeg = frames.captured_at(captured)
    opening, proximity, touching = told["/gripper"].data
    gaze = told["/gaze"].data
    return Observation(
        time_ns=messages.time_of(joints.header),
        posture=joints.position,
        velocity=joints.velocity,
        gaze=gaze,
        frame=frame,
        frame_time_ns=captured,
        frame_gaze=gaze,
        place_noise=np.zeros(2) if noise is None else np.array((noise.point.x, noise.point.y)),
        opening=float(opening),
        proximity=float(proximity),
        touching=bool(touching),
        jpeg=jpeg,
        skipped=tuple(Shot(one, at, gaze, jpeg=kept) for at, one, kept in skipped),
        begins=begins,
    )
