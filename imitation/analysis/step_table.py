"""A recording as a table with one row a control step: columns of numbers, each with its unit."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from imitation.analysis.comparison import numbers
from imitation.recording import messages
from imitation.recording.mcap_recording import Recording
from imitation.recording.recorded_steps import StepTold, events, steps_told
from imitation.recording.step_messages import Message, Topic
from imitation.robot import SECOND

LISTS = ("/attractors/index", "/attractors/activation", "/attractors/pull", "/attractors/posture")
LEFT_OUT = ("/camera/image", "/camera/used", "/events", "/truth/object")
UNITS = {  # of the numbers of a topic, when one holds for all
    "/gaze": "rad",
    "/hand": "px",
    "/hand/noise": "px",
    "/target": "px",
    "/truth/hand": "px",
    "/joint_command/requested": "rad/s",
    "/joint_command/limited": "rad/s",
    "/joint_command/sent": "rad/s",
    "/attractors/posture": "rad",
}
UNITS_OF_ENTRIES = {"position": "rad", "velocity": "rad/s", "distance": "px", "proximity": "m"}


def unit_of(topic: str, entry: str) -> str:
    """Of a topic's entry, such as rad/s; empty: a number without unit, or text."""
    return UNITS.get(topic) or UNITS_OF_ENTRIES.get(entry.rpartition(" ")[2], "")


@dataclass(frozen=True)
class Column:
    """One column."""

    unit: str  # such as rad/s; empty: a number without unit, or text
    values: list[Any]  # one a step; None where nothing was told


def table(recording: Recording) -> dict[str, Column]:
    """The steps of a recording, column by column.

    Raises:
        ValueError: The recording is damaged.
    """
    columns: dict[str, Column] = {}
    count = 0
    for count, row in enumerate(_rows(recording), start=1):
        for name, (unit, value) in row.items():
            column = columns.setdefault(name, Column(unit, [None] * (count - 1)))
            column.values.append(value)
        for column in columns.values():
            if len(column.values) < count:
                column.values.append(None)
    return columns


Row = dict[str, tuple[str, Any]]  # unit and value by the column's name


def _rows(recording: Recording) -> Iterator[Row]:
    episode, truths = -1, dict[int, Message]()
    for told in steps_told(recording):
        episode += told.step.begins
        truths |= {one.time_ns: one for one in told.messages if one.topic == "/truth/hand"}
        row: Row = {
            "time": ("s", told.time_ns / SECOND),
            "frame_time": ("s", told.step.seen.frame_time_ns / SECOND),
            "sent_time": ("s", told.step.sent_ns / SECOND),
            "episode": ("", episode),
        }
        said = [one for one in told.messages if one.topic != "/truth/hand"]
        if told.time_ns in truths:  # told at the end of the step before
            said.append(truths.pop(told.time_ns))
        for message in said:
            if message.topic not in LEFT_OUT:
                row |= _cells(message, recording.topics[message.topic])
        row["events"] = ("", _happened(told))
        yield row


def _cells(message: Message, topic: Topic) -> Row:
    name = message.topic.strip("/").replace("/", ".")
    if message.topic in LISTS:
        told = messages.array(messages.decoded(message.data, topic.type))
        return {name: (unit_of(message.topic, ""), told.tolist())}
    return {
        f"{name}.{entry.replace(' ', '_')}": (unit_of(message.topic, entry), value)
        for entry, value in numbers(message.data, topic).items()
    }


def _happened(told: StepTold) -> str:
    return "; ".join(messages.split_log(event)[0] for event in events(told.messages))
