"""Recorded dialogues of the vendor's library with a Katana; see katana_traces/INDEX.md."""

import json
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).parent / "katana_traces"
NAMES = sorted(path.stem for path in FOLDER.glob("*.json"))
ERROR_FLAG, ASK_FOR_ERROR = bytes.fromhex("c05000"), bytes.fromhex("000000c1")


@dataclass(frozen=True)
class Turn:
    """What the host sent and what the arm said to it."""

    request: bytes
    reply: bytes  # empty: nothing came


def dialogue(name: str) -> list[Turn]:
    """The turns of one dialogue."""
    entries = json.loads((FOLDER / f"{name}.json").read_text())
    frames = [(entry["dir"], bytes.fromhex(entry["hex"])) for entry in entries]
    turns = []
    for number, (who, data) in enumerate(frames):
        if who == "host":
            answered = number + 1 < len(frames) and frames[number + 1][0] == "arm"
            turns.append(Turn(data, frames[number + 1][1] if answered else b""))
    return turns
