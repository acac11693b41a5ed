"""What one control step says in a recording: its messages, in order, with their topics."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from imitation.arrays import Array, Image
from imitation.recording import messages
from imitation.recording.messages import stamp
from imitation.robot import Applied, Body, Truth
from imitation.sample import Decision, Event, Sample
from imitation.visual_field import VisualField

VISUAL_SPACE = "visual_space"  # frame of every place [px]
WORLD = "world"  # frame of every pose [m]
GRID = ("rows", "columns")
OF_ATTRACTORS = ("attractors", "joints")


@dataclass(frozen=True)
class Topic:
    """What a channel of the recording holds."""

    type: str  # ROS 2 message type
    names: tuple[str, ...] = ()  # of an array's entries along its last dimension


class Message(NamedTuple):
    """One message of the recording."""

    topic: str
    time_ns: int  # since the start of the run
    data: bytes  # CDR


def topics(body: Body, field: VisualField, jpeg: bool) -> dict[str, Topic]:
    """Every topic a recording may hold, by name.

    Args:
        body: The arm.
        field: The visual field.
        jpeg: Whether the frames come as JPEG, from a real camera.
    """
    joints = body.joint_names
    areas = tuple(f"area {row},{column}" for row, column in np.ndindex(*field.shape))
    return {
        "/camera/image": Topic(messages.COMPRESSED_IMAGE if jpeg else messages.IMAGE),
        "/camera/used": Topic(messages.HEADER),
        "/joint_states": Topic(messages.JOINT_STATE, joints),
        "/gaze": Topic(messages.FLOATS, ("pan", "tilt")),
        "/gripper": Topic(messages.FLOATS, ("opening", "proximity", "touching")),
        "/hand": Topic(messages.POINT),
        "/hand/noise": Topic(messages.POINT),
        "/visual_input": Topic(messages.FLOATS, areas),
        "/target": Topic(messages.POINT),
        "/selection": Topic(messages.FLOATS, areas),
        "/attractors/index": Topic(messages.INTEGERS, ("row", "column", "neuron")),
        "/attractors/activation": Topic(messages.FLOATS),
        "/attractors/posture": Topic(messages.FLOATS, joints),
        "/attractors/pull": Topic(messages.FLOATS, joints),
        "/dynamics": Topic(messages.FLOATS, ("gain", "noise level", "distance")),
        "/dynamics/noise": Topic(messages.FLOATS, joints),
        "/joint_command/requested": Topic(messages.JOINT_STATE, joints),
        "/joint_command/limited": Topic(messages.JOINT_STATE, joints),
        "/joint_command/sent": Topic(messages.JOINT_STATE, joints),
        "/events": Topic(messages.LOG),
        "/truth/hand": Topic(messages.POINT),
        "/truth/object": Topic(messages.POSE),
    }


class StepMessages:
    """Makes the messages of one step after the other; a frame seen twice is told once.

    Args:
        body: The arm; its joint names go into every JointState.
    """

    def __init__(self, body: Body) -> None:
        self._joints = body.joint_names
        self._frame_time_ns: int | None = None
        self._reasons: tuple[str, ...] = ()

    def of(self, sample: Sample, truths: Sequence[Truth]) -> Iterator[Message]:
        """The step's messages: senses, decision, what was applied, events, truth."""
        yield from self._senses(sample)
        yield from self._decision(sample.seen.time_ns, sample.decision)
        yield from self._applied(sample.applied)
        for event in sample.events:
            yield event_message(sample.seen.time_ns, event)
        for truth in truths:
            yield from _truth(truth)

    def _senses(self, sample: Sample) -> Iterator[Message]:
        seen, percept, now = sample.seen, sample.percept, sample.seen.time_ns
        captured = stamp(seen.frame_time_ns)
        if seen.frame_time_ns != self._frame_time_ns:
            self._frame_time_ns = seen.frame_time_ns
            for shot in seen.skipped:
                picture = _picture(shot.frame, shot.jpeg, shot.time_ns)
                yield Message("/camera/image", shot.time_ns, picture)
            picture = _picture(seen.frame, seen.jpeg, seen.frame_time_ns)
            yield Message("/camera/image", seen.frame_time_ns, picture)
        yield Message("/camera/used", now, messages.header_form("camera").fill(captured))
        joints = messages.joint_form(self._joints)
        state = joints.fill(stamp(now), doubles(seen.posture), doubles(seen.velocity))
        yield Message("/joint_states", now, state)
        yield Message("/gaze", now, _floats(seen.gaze, ("pan, tilt",)))
        gripper = np.array((seen.opening, seen.proximity, seen.touching))
        yield Message("/gripper", now, _floats(gripper, ("opening, proximity, touching",)))
        if np.count_nonzero(seen.place_noise):
            yield Message("/hand/noise", now, _place(captured, seen.place_noise))
        if percept.hand is not None:
            yield Message("/hand", now, _place(stamp(percept.time_ns), percept.hand))
        yield Message("/visual_input", now, _floats(percept.visual_input, GRID))

    def _decision(self, now: int, decision: Decision) -> Iterator[Message]:
        if decision.target is not None:
            yield Message("/target", now, _place(stamp(now), decision.target))
        yield Message("/selection", now, _floats(decision.selection, GRID))
        index = np.ascontiguousarray(decision.index, dtype="<i4")
        form = messages.integers_form(index.shape, ("attractors", "row, column, neuron"))
        yield Message("/attractors/index", now, form.fill(index))
        activation = _floats(decision.activation, ("attractors",))
        yield Message("/attractors/activation", now, activation)
        if np.count_nonzero(index < 0):
            yield Message("/attractors/posture", now, _floats(decision.postures, OF_ATTRACTORS))
        yield Message("/attractors/pull", now, _floats(decision.shares, OF_ATTRACTORS))
        dynamics = np.array((decision.gain, decision.noise_level, decision.distance))
        yield Message("/dynamics", now, _floats(dynamics, ("gain, noise level, distance",)))
        yield Message("/dynamics/noise", now, _floats(decision.noise, ("joints",)))

    def _applied(self, applied: Applied) -> Iterator[Message]:
        now, sent = applied.time_ns, stamp(applied.time_ns)
        fill = messages.velocity_form(self._joints).fill
        yield Message("/joint_command/requested", now, fill(sent, doubles(applied.requested)))
        yield Message("/joint_command/limited", now, fill(sent, doubles(applied.limited)))
        yield Message("/joint_command/sent", now, fill(sent, doubles(applied.sent)))
        if applied.reasons != self._reasons:
            self._reasons = applied.reasons
            yield event_message(now, _limitation(applied.reasons))


def _limitation(reasons: tuple[str, ...]) -> Event:
    if not reasons:
        return Event("limited", "The guard no longer limits the velocity.", {"reasons": []})
    why = ", ".join(reasons)
    return Event("limited", f"The guard limits the velocity: {why}.", {"reasons": list(reasons)})


def event_message(time_ns: int, event: Event) -> Message:
    """The message of an event."""
    data = messages.log(time_ns, event.kind, event.sentence, event.facts)
    return Message("/events", time_ns, data)


def _truth(truth: Truth) -> Iterator[Message]:
    when = stamp(truth.time_ns)
    yield Message("/truth/hand", truth.time_ns, _place(when, truth.hand_px))
    if truth.object_pose is not None:
        pose = messages.pose_form(WORLD).fill(when, doubles(truth.object_pose))
        yield Message("/truth/object", truth.time_ns, pose)


def _picture(frame: Image, jpeg: bytes | None, time_ns: int) -> bytes:
    if jpeg is not None:
        return messages.compressed_image(time_ns, jpeg)
    pixels = np.ascontiguousarray(frame)
    height, width, channels = pixels.shape
    return messages.image_form((height, width, channels)).fill(stamp(time_ns), pixels)


def _place(when: bytes, place: Array) -> bytes:
    x_y_z = np.array((place[0], place[1], 0.0))
    return messages.point_form(VISUAL_SPACE).fill(when, x_y_z)


def _floats(values: Array, labels: tuple[str, ...]) -> bytes:
    return messages.floats_form(values.shape, labels).fill(doubles(values))


def doubles(values: Array) -> Array:
    """`values` as they lie in a message."""
    return np.ascontiguousarray(values, dtype="<f8")
