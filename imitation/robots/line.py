"""A line to a device: bytes out, bytes in, and how long to wait for them."""

import socket
import time
from typing import Protocol

from imitation.device import DeviceError


class Line(Protocol):
    """A line that carries requests to a device and its replies back."""

    name: str  # how a person would find it: an address or a port

    def send(self, data: bytes) -> None:
        """Send all of `data`."""

    def receive(self, count: int, timeout: float) -> bytes:
        """The next `count` bytes, or those that came within `timeout` [s]."""

    def drain(self) -> None:
        """Throw away what has come unasked."""

    def close(self) -> None:
        """Release the line; harmless when repeated."""


class TcpLine:
    """A TCP connection.

    Args:
        address: Host or address of the device.
        port: Its TCP port.
        timeout: How long connecting and sending may take [s].
    """

    def __init__(self, address: str, port: int, timeout: float) -> None:
        self.name = f"{address}:{port}"
        try:
            self._socket = socket.create_connection((address, port), timeout)
        except OSError as error:
            raise DeviceError(f"nothing answers at {self.name} ({error})") from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._timeout = timeout

    def send(self, data: bytes) -> None:
        """Send all of `data`."""
        self._socket.settimeout(self._timeout)
        try:
            self._socket.sendall(data)
        except OSError as error:
            raise self._cut(error) from error

    def receive(self, count: int, timeout: float) -> bytes:
        """The next `count` bytes, or those that came within `timeout` [s]."""
        received, until = b"", time.monotonic() + timeout
        while len(received) < count and (left := until - time.monotonic()) > 0:
            self._socket.settimeout(left)
            try:
                came = self._socket.recv(count - len(received))
            except TimeoutError:
                break
            except OSError as error:
                raise self._cut(error) from error
            if not came:
                raise self._cut("it closed the connection")
            received += came
        return received

    def drain(self) -> None:
        """Throw away what has come unasked."""
        self._socket.setblocking(False)
        try:
            while self._socket.recv(4096):
                pass
        except BlockingIOError:
            return
        except OSError as error:
            raise self._cut(error) from error
        raise self._cut("it closed the connection")

    def close(self) -> None:
        """Release the line; harmless when repeated."""
        self._socket.close()

    def _cut(self, why: object) -> DeviceError:
        return DeviceError(f"the connection to {self.name} is cut: {why}")
