"""Frames of the Katana's wire protocol: CRC, requests and replies (facts/katana.md, 2.2)."""

from imitation.device import DeviceError

ADDRESS = 24  # of every Katana
ERROR_FLAG = 0xC0  # a reply of this alone: the request was refused (2.5)
ASK_FOR_ERROR = bytes((0, 0, 0, 0xC1))  # sent bare, without header and CRC (2.5)
ERROR_REPORT = 0xC1
ERROR_TEXT = 51  # bytes of text in an error report


def _table_entry(byte: int) -> int:
    for _ in range(8):
        byte = (byte >> 1) ^ (0xA001 if byte & 1 else 0)
    return byte


TABLE = tuple(_table_entry(byte) for byte in range(256))

# Payload bytes of each request and of its reply, by the command's letter (2.3).
SIZES = {
    ord("B"): (1, 3),
    ord("X"): (1, 181),
    ord("Y"): (1, 84),
    ord("Z"): (1, 1),
    ord("C"): (5, 3),
    ord("D"): (2, 8),
    ord("E"): (2, 18),
    ord("V"): (3, 13),
    ord("N"): (3, 13),
    ord("G"): (14, 2),
    ord("G") + 128: (3, 2),
    ord("H"): (75, 3),
    ord("A"): (3, 2),
    ord("S"): (6, 6),
    ord("I"): (2, 3),
    ord("M"): (5, 4),
    ord("T"): (5, 2),
}
MAY_FAIL = b"CDVE"  # a reply to these whose second byte is 0 means failure (2.3)


class BadReplyError(DeviceError):
    """A reply that is short, damaged, or to another request: worth asking again."""


def crc(data: bytes) -> int:
    """CRC-16/ARC of `data`."""
    value = 0
    for byte in data:
        value = (value >> 8) ^ TABLE[(value ^ byte) & 0xFF]
    return value


def sealed(payload: bytes) -> bytes:
    """`payload` with its CRC, high byte first."""
    return payload + crc(payload).to_bytes(2, "big")


def request_frame(payload: bytes) -> bytes:
    """What is sent for a request."""
    return bytes((1, ADDRESS, len(payload))) + sealed(payload)


def reply_length(request: bytes) -> int:
    """Bytes on the wire of the reply to the request with this payload."""
    return SIZES[request[0]][1] + 2


def reply_payload(request: bytes, received: bytes) -> bytes:
    """The payload of a reply to `request`.

    Raises:
        BadReplyError: It is none.
    """
    asked = chr(request[0] & 0x7F)
    if len(received) < reply_length(request):
        wanted = reply_length(request)
        raise BadReplyError(f"{len(received)} bytes came of {wanted} in reply to {asked}")
    payload = received[:-2]
    if sealed(payload) != received:
        raise BadReplyError(f"the reply to {asked} came with a wrong CRC")
    if payload[0] != request[0] | 0x20:
        raise BadReplyError(f"the reply to {asked} begins with {payload[0]:#04x}")
    return payload
