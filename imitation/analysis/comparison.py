"""What was decided anew against what a recording says was decided: where and by how much."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from imitation.recording import messages
from imitation.recording.step_messages import Message, Topic
from imitation.robot import SECOND

TRUTH = "/truth/"  # beginning of the topics that no decision rests on
TERMS = {
    "/hand": "seen hand",
    "/target": "target",
    "/visual_input": "visual input I",
    "/selection": "selection V",
    "/attractors/index": "attractor",
    "/attractors/activation": "activation N V",
    "/attractors/posture": "attractor's posture",
    "/attractors/pull": "pull, share of f(x)",
    "/dynamics": "",  # its entries say it
    "/dynamics/noise": "noise",
    "/joint_command/requested": "requested velocity",
    "/joint_command/limited": "limited velocity",
    "/joint_command/sent": "sent velocity",
    "/events": "event",
}


@dataclass(frozen=True)
class Difference:
    """Two messages that are not the same."""

    time_ns: int  # since the start of the run
    topic: str
    term: str  # which of its numbers, in words
    recorded: str
    recomputed: str
    size: float  # largest distance of two numbers; inf: not the same numbers at all

    @property
    def sentence(self) -> str:
        """The difference in one line."""
        by = f", off by {self.size:.3g}" if np.isfinite(self.size) else ""
        return (
            f"at {self.time_ns / SECOND:.3f} s on {self.topic}, {self.term}: "
            f"recorded {self.recorded}, recomputed {self.recomputed}{by}"
        )


@dataclass
class TopicDifferences:
    """What differs on one topic."""

    first: Difference
    steps: int = 0
    largest: float = 0.0


@dataclass
class Comparison:
    """Compares one step after the other, message by message, bit for bit.

    Args:
        topics: Of the recording.
    """

    topics: Mapping[str, Topic]
    steps: int = 0  # that were compared
    differing: dict[str, TopicDifferences] = field(default_factory=dict)

    @property
    def first(self) -> Difference | None:
        """The first difference; within a step in the order of the computation."""
        found = [one.first for one in self.differing.values()]
        return min(found, key=lambda one: one.time_ns, default=None)  # the first of equals

    def add(self, recorded: Sequence[Message], recomputed: Sequence[Message]) -> None:
        """Compare a step with what was decided anew."""
        self.steps += 1
        for one, other in _pairs(recorded, recomputed):
            if one is None or other is None or one != other:
                self.note(self._difference(one, other))
        order, due = _order(recorded), _order(recomputed)
        if sorted(order) == sorted(due):
            for came, wanted in zip(order, due, strict=True):
                if came != wanted:
                    at = recomputed[0].time_ns
                    self.note(Difference(at, wanted, "order of messages", came, wanted, np.inf))

    def note(self, found: Difference) -> None:
        """Count a difference."""
        on_topic = self.differing.setdefault(found.topic, TopicDifferences(found))
        on_topic.steps += 1
        on_topic.largest = max(on_topic.largest, found.size)

    def _difference(self, one: Message | None, other: Message | None) -> Difference:
        told = one or other
        assert told is not None
        kind = self.topics.get(told.topic) or Topic(messages.FLOATS)
        if one is None or other is None or one.time_ns != other.time_ns:
            word = TERMS.get(told.topic) or "message"
            size = np.inf
            return Difference(told.time_ns, told.topic, word, _count(one), _count(other), size)
        before, after = (numbers(message.data, kind) for message in (one, other))
        entry, size = _farthest(before, after)
        term = " ".join((TERMS.get(told.topic, "message"), entry)).strip()
        return Difference(
            told.time_ns, told.topic, term, _shown(before, entry), _shown(after, entry), size
        )


def numbers(data: bytes, topic: Topic) -> dict[str, Any]:
    """What a message says, each number by its name; a log its text."""
    told = messages.decoded(data, topic.type)
    if topic.type == messages.LOG:
        return {told.name: told.msg}
    if topic.type == messages.JOINT_STATE:
        parts = {"position": told.position, "velocity": told.velocity}
        return {
            f"{name} {part}": value
            for part, values in parts.items()
            for name, value in zip(topic.names, values.tolist(), strict=False)
        }
    if topic.type == messages.POINT:
        return {"x": told.point.x, "y": told.point.y}
    if topic.type in (messages.FLOATS, messages.INTEGERS):
        return _entries(messages.array(told), topic.names)
    return {"content": data.hex()}


def _entries(values: Any, names: Sequence[str]) -> dict[str, Any]:
    flat = values.ravel().tolist()
    if values.ndim == 2 and values.shape[1] == len(names):
        rows = range(len(values))
        words = [f"of attractor {row + 1}, {name}" for row in rows for name in names]
    elif len(names) == len(flat):
        words = list(names)
    else:
        words = [f"of number {one + 1}" for one in range(len(flat))]
    return dict(zip(words, flat, strict=True))


def _pairs(
    recorded: Sequence[Message], recomputed: Sequence[Message]
) -> Iterator[tuple[Message | None, Message | None]]:
    """The messages of each topic side by side, in the order recomputed; frames are fed."""
    before, after = _by_topic(recorded), _by_topic(recomputed)
    for topic in dict.fromkeys((*after, *before)):
        one, other = before.get(topic, []), after.get(topic, [])
        for number in range(max(len(one), len(other))):
            yield (
                one[number] if number < len(one) else None,
                other[number] if number < len(other) else None,
            )


def _order(said: Sequence[Message]) -> list[str]:
    return [message.topic for message in said if not _is_given(message)]


def _by_topic(said: Sequence[Message]) -> dict[str, list[Message]]:
    found: dict[str, list[Message]] = {}
    for message in said:
        if not _is_given(message):
            found.setdefault(message.topic, []).append(message)
    return found


def _is_given(message: Message) -> bool:
    """Whether a message tells what nobody decided: frames, truth, the failure of a device."""
    if message.topic == "/events":
        return bool(messages.decoded(message.data, messages.LOG).name == "device")
    return message.topic == "/camera/image" or message.topic.startswith(TRUTH)


def _farthest(before: dict[str, Any], after: dict[str, Any]) -> tuple[str, float]:
    """The entry that is farthest off, and by how much."""
    if before.keys() != after.keys():
        missing = [name for name in (*before, *after) if name not in before or name not in after]
        return missing[0], np.inf
    off = {name: _distance(before[name], after[name]) for name in before}
    farthest = max(off, key=lambda name: off[name], default="")
    return farthest, off.get(farthest, np.inf)


def _distance(one: Any, other: Any) -> float:
    if isinstance(one, str) or np.isnan(one) != np.isnan(other):
        return 0.0 if one == other else np.inf
    return float(np.nan_to_num(abs(one - other)))


def _shown(told: dict[str, Any], entry: str) -> str:
    value = told.get(entry, "none")
    return value if isinstance(value, str) else f"{value:.17g}"


def _count(message: Message | None) -> str:
    return "none" if message is None else "one"
