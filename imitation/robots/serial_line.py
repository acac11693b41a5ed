"""Serial lines. The one module that knows pyserial."""

import termios

import serial

from imitation.device import DeviceError

# What pyserial raises, or lets through, when a port goes away while it is used.
LOST = (OSError, termios.error, TypeError)


class SerialLine:
    """A serial port: 8 data bits, no parity, 1 stop bit, no flow control.

    Args:
        port: Its device file.
        baud: Bits per second.
        timeout: How long sending may take [s].
    """

    def __init__(self, port: str, baud: int, timeout: float) -> None:
        self.name = port
        try:
            self._port = serial.Serial(port, baud, write_timeout=timeout, exclusive=True)
        except (serial.SerialException, ValueError) as error:
            raise DeviceError(f"serial port {port} cannot be opened: {error}") from error

    def send(self, data: bytes) -> None:
        """Send all of `data`."""
        try:
            self._port.write(data)
        except LOST as error:
            raise self._cut(error) from error

    def receive(self, count: int, timeout: float) -> bytes:
        """The next `count` bytes, or those that came within `timeout` [s]."""
        try:
            self._port.timeout = timeout
            return bytes(self._port.read(count))
        except LOST as error:
            raise self._cut(error) from error

    def drain(self) -> None:
        """Throw away what has come unasked."""
        try:
            self._port.reset_input_buffer()
        except LOST as error:
            raise self._cut(error) from error

    def close(self) -> None:
        """Release the line; harmless when repeated."""
        self._port.close()

    def _cut(self, why: object) -> DeviceError:
        return DeviceError(f"serial port {self.name} failed: {why}")
