"""Asks a Katana and gets its reply, again when that was damaged (facts/katana.md, 2.5)."""

from dataclasses import dataclass, field

from imitation.device import DeviceError
from imitation.robots.katana.commands import ECHO
from imitation.robots.katana.frames import (
    ASK_FOR_ERROR,
    ERROR_FLAG,
    ERROR_REPORT,
    ERROR_TEXT,
    MAY_FAIL,
    BadReplyError,
    reply_length,
    reply_payload,
    request_frame,
    sealed,
)
from imitation.robots.line import Line

REFUSED = sealed(bytes((ERROR_FLAG,)))
REPORT_LENGTH = 4 + ERROR_TEXT + 2
CODES = {
    -1: "failed",
    -2: "invalid argument",
    -3: "wrong state",
    -4: "wrong type",
    -5: "out of range",
    -6: "an axis lost its heartbeat",
    -7: "an axis is not operational",
    -8: "an axis failed to move",
    -9: "an axis failed in a spline",
    -10: "collision",
    -11: "an axis failed",
    -12: "wrong CRC",
    -13: "a peripheral failed",
}


class RefusedError(DeviceError):
    """The arm answered that it will not, or cannot, do what it was asked.

    Args:
        sentence: What it told, for people.
        code: Its error code; 0 when it gave none.
        axis: The motor that is to blame; 0: none.
    """

    def __init__(self, sentence: str, code: int = 0, axis: int = 0) -> None:
        super().__init__(sentence)
        self.code, self.axis = code, axis


@dataclass
class Connection:
    """One request, one reply; the arm never speaks first.

    Args:
        line: To the arm.
        tells_errors: Whether the arm answers a refusal with an error flag: 400 and 450 do.
        timeout: How long a whole reply may take [s].
        tries: How often a request is sent before the arm counts as dead.
    """

    line: Line
    tells_errors: bool
    timeout: float
    tries: int
    repeats: int = 0  # requests that had to be sent again
    _late: bool = field(default=False, init=False)  # a reply may still be on its way
    _last: bytes = field(default=b"", init=False)  # the request before

    def ask(self, request: bytes) -> bytes:
        """Payload of the reply to a request that may safely arrive twice.

        Raises:
            RefusedError: The arm said no.
            DeviceError: It said nothing that makes sense, or nothing at all.
        """
        for attempt in range(self.tries):
            try:
                reply = self.ask_once(request)
            except BadReplyError as error:
                trouble = error
                continue
            self.repeats += attempt
            return reply
        raise DeviceError(
            f"the Katana at {self.line.name} was asked {chr(request[0] & 0x7F)} {self.tries} times "
            f"in vain: {trouble}; check its power, its cable and that nothing else talks to it"
        )

    def ask_once(self, request: bytes) -> bytes:
        """The same for a request that must not arrive twice, such as a spline.

        Raises:
            BadReplyError: Whether the arm obeyed is not known.
        """
        self._pass_late_replies(request)
        self.line.drain()
        self.line.send(request_frame(request))
        received = self._receive(reply_length(request))
        if self.tells_errors and received == REFUSED:
            raise self._refusal()
        self._late |= len(received) < reply_length(request)
        payload = reply_payload(request, received)
        if request[0] in MAY_FAIL and payload[1] == 0:
            raise RefusedError(f"the Katana refuses {chr(request[0])} of motor {request[1] & 0x7F}")
        if request[0] in b"DV" and payload[1] != request[1]:
            raise BadReplyError(f"motor {payload[1]} answered for motor {request[1]}")
        return payload

    def _pass_late_replies(self, request: bytes) -> None:
        """After a silence replies may come late: they are over when an echo comes back."""
        repeated, self._last = request == self._last, request
        if not self._late or repeated:
            return
        for _ in range(self.tries):
            self.line.send(request_frame(ECHO))
            received = b""
            while more := self.line.receive(1, self.timeout):
                received += more
                if received.endswith(sealed(b"z")):
                    self._late = False
                    return
        raise DeviceError(f"the Katana at {self.line.name} fell silent")

    def _receive(self, length: int) -> bytes:
        if not self.tells_errors:
            return self.line.receive(length, self.timeout)
        received = self.line.receive(len(REFUSED), self.timeout)
        if received == REFUSED or len(received) < len(REFUSED):
            return received
        return received + self.line.receive(length - len(REFUSED), self.timeout)

    def _refusal(self) -> RefusedError:
        self.line.send(ASK_FOR_ERROR)
        report = self.line.receive(REPORT_LENGTH, self.timeout)
        if sealed(report[:-2]) != report or report[:1] != bytes((ERROR_REPORT,)):
            return RefusedError("the Katana refuses, and its error report cannot be read")
        letter, axis = chr(report[1] & 0x7F), report[3]
        code = int.from_bytes(report[2:3], signed=True)
        told = report[4:-2].rstrip(b"\0").decode("ascii", "replace")
        where = f" of motor {axis}" if axis else ""
        meaning = CODES.get(code, f"error {code}")
        return RefusedError(f"the Katana refuses {letter}{where}: {meaning} ({told})", code, axis)
