"""Whether a recording still says what it said when it was written."""

from dataclasses import dataclass

from imitation.recording.digest import ATTACHMENT, OVERALL, RECORD
from imitation.recording.mcap_recording import Recording, digest_number
from imitation.robot import SECOND

BESIDE = {ATTACHMENT: "the attachment", RECORD: "the record"}
CITED = 20  # hexadecimal digits of a digest: 80 bits


@dataclass(frozen=True)
class Break:
    """A topic, or something beside the messages, that is not what the recorder wrote."""

    topic: str  # or the digest's name of what is none
    from_ns: int  # it happened between these two times of the run
    to_ns: int

    @property
    def sentence(self) -> str:
        """The break in one line."""
        for beside, what in BESIDE.items():
            if self.topic.startswith(beside):
                name = self.topic.removeprefix(beside)
                return f"{what} {name} was changed after it was written"
        return (
            f"{self.topic} was changed after it was written, "
            f"between {self.from_ns / SECOND:.2f} and {self.to_ns / SECOND:.2f} s"
        )


def broken(recording: Recording) -> list[Break]:
    """Each topic that was changed, with the chunk where it happened first.

    Raises:
        ValueError: The file is damaged.
    """
    digest, found = recording.begun_digest(), dict[str, Break]()
    end_ns, number = 0, 0
    for number, chunk in enumerate(recording.chunks(), start=1):
        start_ns = min((message.time_ns for message in chunk), default=end_ns)
        end_ns = max((message.time_ns for message in chunk), default=end_ns)
        digest.add(chunk)
        name = f"digest/{number:04d}"
        told, now = recording.metadata.get(name), digest.values()
        if told is None and not recording.whole:
            break  # cut between a chunk and its digest
        for topic in [RECORD + name] if told is None else _changed(told, now):
            found.setdefault(topic, Break(topic, start_ns, end_ns))
    if not number:  # nothing but what stands before the messages
        for name in _changed(recording.digest() or digest.values(), digest.values()):
            found.setdefault(name, Break(name, 0, 0))
    beyond = [name for name in recording.metadata if digest_number(name) > max(number, 1)]
    if beyond:
        found.setdefault("the end", Break("the end", end_ns, end_ns))
    return sorted(found.values(), key=lambda one: one.from_ns)


def cited(digest: dict[str, str]) -> str:
    """A digest as it is quoted: the first digits, in groups of four."""
    digits = digest.get(OVERALL, "")[:CITED]
    return " ".join(digits[start : start + 4] for start in range(0, len(digits), 4))


def _changed(told: dict[str, str], now: dict[str, str]) -> list[str]:
    changed = [topic for topic in (*told, *now) if told.get(topic) != now.get(topic)]
    topics = [topic for topic in dict.fromkeys(changed) if topic != OVERALL]
    return topics or ["digest"] * bool(changed)
