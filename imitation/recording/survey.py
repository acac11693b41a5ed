"""What topics a recording of any program holds: how many messages, how often, how large."""

import sqlite3
from collections.abc import Iterable
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path

from imitation.recording.mcap_reading import Contents
from imitation.recording.mcap_survey import sizes
from imitation.robot import SECOND


@dataclass
class TopicSurvey:
    """One topic of a recording."""

    type: str  # of its messages, such as sensor_msgs/msg/Image
    messages: int = 0
    first_ns: int = 0  # time of the first message
    last_ns: int = 0
    gap_ns: int = 0  # longest time between two messages
    bytes: int = 0  # of all messages, uncompressed

    def add(self, time_ns: int, size: int) -> None:
        """One more message."""
        if not self.messages:
            self.first_ns = self.last_ns = time_ns
        self.gap_ns = max(self.gap_ns, time_ns - self.last_ns)
        self.first_ns = min(self.first_ns, time_ns)  # not every program writes them in order
        self.last_ns = max(self.last_ns, time_ns)
        self.messages, self.bytes = self.messages + 1, self.bytes + size

    @property
    def rate(self) -> float | None:
        """Messages a second [Hz]; None when there are too few."""
        lasting = self.last_ns - self.first_ns
        return (self.messages - 1) * SECOND / lasting if lasting > 0 else None


@dataclass
class Survey:
    """A recording of any program, as far as it can be read."""

    kind: str  # in words
    whole: bool = True  # closed as it should be
    topics: dict[str, TopicSurvey] = field(default_factory=dict)

    @property
    def lasting(self) -> float:
        """From the first to the last message [s]."""
        told = [topic for topic in self.topics.values() if topic.messages]
        if not told:
            return 0.0
        first, last = min(one.first_ns for one in told), max(one.last_ns for one in told)
        return (last - first) / SECOND


def survey(path: Path) -> Survey:
    """Survey an MCAP file, a ROS 2 bag of SQLite, or the folder of one.

    Raises:
        ValueError: There is none, or it is damaged; the message says which.
    """
    files = _files(path)
    found = Survey("ROS 2 bag")
    for file in files:
        if file.suffix == ".db3":
            found.kind = "ROS 2 bag (SQLite)"
            _add_sqlite(file, found)
        else:
            _add_mcap(file, found)
    return found


def _files(path: Path) -> list[Path]:
    if not path.is_dir():
        if not path.is_file():
            raise ValueError(f"no recording at {path}; give a run folder, an .mcap or a ROS 2 bag")
        return [path]
    if (path / "run.mcap").is_file():
        return [path / "run.mcap"]
    bags = sorted((*path.glob("*.mcap"), *path.glob("*.db3")))
    if not (path / "metadata.yaml").is_file() or not bags:
        raise ValueError(f"no recording in {path}: it holds no run.mcap and is no ROS 2 bag")
    return bags


def _add_mcap(path: Path, found: Survey) -> None:
    contents = Contents()
    for time_ns, channel, size in sizes(path, contents):
        schema = contents.schemas.get(channel.schema_id)
        kind = schema.name if schema else channel.message_encoding
        found.topics.setdefault(channel.topic, TopicSurvey(kind)).add(time_ns, size)
    profile = contents.profile or "no profile"
    found.kind = "ROS 2 bag (MCAP)" if profile == "ros2" else f"MCAP file, {profile}"
    found.whole = found.whole and contents.whole


def _add_sqlite(path: Path, found: Survey) -> None:
    try:
        with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as bag:
            known = bag.execute("SELECT id, name, type FROM topics").fetchall()
            for number, name, kind in known:
                told = bag.execute(
                    "SELECT timestamp, length(data) FROM messages WHERE topic_id = ? "
                    "ORDER BY timestamp",
                    (number,),
                )
                _add_all(found.topics.setdefault(str(name), TopicSurvey(str(kind))), told)
    except (sqlite3.Error, TypeError) as error:
        raise ValueError(f"{path} is no ROS 2 bag of SQLite, or is damaged: {error}") from error


def _add_all(topic: TopicSurvey, told: Iterable[tuple[int, int]]) -> None:
    for time_ns, size in told:
        topic.add(time_ns, size)
