"""What a batch of recorded steps shows: numbers by topic, ready to be drawn as columns."""

import io
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from imitation.arrays import Array
from imitation.recording import messages
from imitation.recording.overview import Grid
from imitation.recording.step_messages import Message, Topic

Times = NDArray[np.int64]  # since the start of the run [ns]


class Batch:
    """Messages of some steps, by topic; decoded when asked for.

    Args:
        told: The messages.
        topics: Their types.
    """

    def __init__(self, told: Iterable[Message], topics: dict[str, Topic]) -> None:
        self._topics = topics
        self._told: dict[str, list[Message]] = {}
        self._decoded: dict[str, list[Any]] = {}
        for message in told:
            self._told.setdefault(message.topic, []).append(message)

    def __contains__(self, topic: str) -> bool:
        return topic in self._told

    def type_of(self, topic: str) -> str:
        """The message type of a topic."""
        return self._topics[topic].type

    def times(self, topic: str) -> Times:
        """When the messages of a topic were said, (n,) [ns]."""
        return np.array([message.time_ns for message in self._told.get(topic, ())], dtype=np.int64)

    def messages(self, topic: str) -> Sequence[Any]:
        """The messages of a topic."""
        if topic not in self._decoded:
            self._decoded[topic] = [
                messages.decoded(message.data, self._topics[topic].type)
                for message in self._told.get(topic, ())
            ]
        return self._decoded[topic]

    def vectors(self, topic: str, part: str = "data") -> Array:
        """A vector of each message, (n, length)."""
        return np.stack([getattr(message, part) for message in self.messages(topic)])

    def pixels(self) -> NDArray[np.uint8]:
        """Pixels of the frames, (n, height * width * 3)."""
        return np.stack([message.data for message in self.messages("/camera/image")])

    def grids(self, topic: str, grid: Grid) -> Array:
        """Values of the areas, (n, rows, columns); activation is that of an area's attractors."""
        if topic != "/attractors/activation":
            return self.vectors(topic).reshape(-1, *grid.shape)
        areas = np.zeros((len(self._told[topic]), *grid.shape))
        attractors = zip(self.messages("/attractors/index"), self.messages(topic), strict=True)
        for area, (index, activation) in zip(areas, attractors, strict=True):
            row, column, _ = messages.array(index).T
            in_map = row >= 0
            np.add.at(area, (row[in_map], column[in_map]), activation.data[in_map])
        return areas

    def captured(self) -> Times:
        """When the frame that each step decided on was captured, (n,) [ns]."""
        used = (messages.time_of(message) for message in self.messages("/camera/used"))
        return np.fromiter(used, dtype=np.int64)

    def places(self, topic: str) -> tuple[Array, list[int]]:
        """Places (x, y) [px] that were told, and how many (0 or 1) at each step."""
        points = [message.point for message in self.messages(topic)]
        places = np.array([(point.x, point.y) for point in points]).reshape(-1, 2)
        told = np.isin(self.times("/camera/used"), self.times(topic))
        return places, told.astype(int).tolist()

    def places_or_nan(self, topic: str) -> Array:
        """The place of each step (n, 2) [px]; nan, where a line ends, for none."""
        places, told = self.places(topic)
        found = np.full((len(told), 2), np.nan)
        found[np.array(told, dtype=bool)] = places
        return found

    def learned(self) -> dict[int, tuple[float, float]]:
        """Where the hand was seen when an area was learned [px], by time [ns]."""
        found = {}
        for time_ns, message in zip(
            self.times("/events").tolist(), self.messages("/events"), strict=True
        ):
            if message.name == "learned":
                _, facts = messages.split_log(message)
                found[time_ns] = tuple(facts["place_px"])
        return found


def learned_places(map_npz: bytes) -> Array:
    """Where the hand was seen in each learned area, (n, 2) [px], as a map file tells."""
    with np.load(io.BytesIO(map_npz)) as saved:
        places = saved["places"].reshape(-1, 2)
    return np.asarray(places[np.isfinite(places).all(axis=1)])
