"""Tells a film that was cut short by what its container promises: MP4, AVI, Matroska and WebM."""

from collections.abc import Iterator
from pathlib import Path

HEAD = 64  # holds what the other two promise [bytes]
RIFF, EBML, SEGMENT = b"RIFF", b"\x1a\x45\xdf\xa3", b"\x18\x53\x80\x67"


def missing_bytes(path: Path) -> int:
    """How many bytes a film lacks at its end; 0 when it is whole, or nobody can tell."""
    there = path.stat().st_size
    with path.open("rb") as film:
        head = film.read(HEAD)
    if head[4:8] == b"ftyp":
        return max(0, max(_box_ends(path, there)) - there)
    if head[:4] == RIFF:
        return max(0, int.from_bytes(head[4:8], "little") + 8 - there)
    if head[:4] == EBML and len(head) == HEAD:
        return max(0, _segment_end(head) - there)
    return 0


def _box_ends(path: Path, there: int) -> Iterator[int]:
    """Where each box of an MP4 ends [bytes]."""
    begins = 0
    with path.open("rb") as film:
        while begins < there:
            film.seek(begins)
            head = film.read(16)
            size = int.from_bytes(head[:4], "big")
            if size == 1:  # too large for 32 bits
                size = int.from_bytes(head[8:], "big")
            yield begins + size
            if size < 8:  # 0: to the end of the file
                return
            begins += size


def _segment_end(head: bytes) -> int:
    """Where a Matroska segment ends [bytes]; 0 when that is not told, as in a live stream."""
    after, size = _varied(head, len(EBML))
    told = after + size + len(SEGMENT)
    if head[after + size : told] != SEGMENT or told == len(head):
        return 0
    begins, size = _varied(head, told)
    untold = size == 2 ** (7 * (begins - told)) - 1
    return 0 if untold else begins + size


def _varied(head: bytes, begins: int) -> tuple[int, int]:
    """Where an EBML number of varied length ends, and the number."""
    length = 9 - head[begins].bit_length()
    mask = (1 << (7 * length)) - 1
    return begins + length, int.from_bytes(head[begins : begins + length], "big") & mask
