"""Serves an emulated device over the real transport: TCP on this computer, or a pty."""

import os
import selectors
import socket
import time
import tty
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from imitation.robots.faults import Faults, Kind

# Faults of any line, and what each of them does.
LINE_FAULTS = {
    "silence": Kind("no reply comes"),
    "wrong_crc": Kind("the last byte of each reply is wrong"),
    "split": Kind("each reply comes in two pieces"),
    "late": Kind("each reply comes late"),
    "cut": Kind("the connection is cut"),
}
SPLIT = 0.02  # between the two pieces [s]
LATE = 0.4  # more than a client waits [s]
LOOK = 0.02  # how often the device goes on while nobody speaks [s]
PTYS = Path("/dev/pts")


class Device(Protocol):
    """An emulated device at the other end of a line."""

    faults: Faults

    def heard(self, data: bytes) -> Iterable[bytes]:
        """Replies to what has just come in."""

    def pass_time(self) -> float:
        """Go on until now; returns the device's time since it was first spoken to [s]."""


class CutError(Exception):
    """The connection is to be cut."""


@dataclass
class Server:
    """Carries bytes between clients and a device until told to stop."""

    device: Device
    where: str = ""  # what a client types to get here
    stopped: bool = False
    _selector: selectors.DefaultSelector = field(default_factory=selectors.DefaultSelector)
    _opened: ExitStack = field(default_factory=ExitStack)

    def listen(self, port: int) -> None:
        """Take clients on 127.0.0.1; port 0 chooses a free one."""
        try:
            listener = socket.create_server(("127.0.0.1", port))
        except (OSError, OverflowError) as error:
            raise ValueError(f"port {port} on 127.0.0.1 cannot be used: {error}") from error
        self.where = f"127.0.0.1:{listener.getsockname()[1]}"
        self._selector.register(listener, selectors.EVENT_READ, self._accept)
        self._opened.callback(listener.close)

    def open_pty(self, path: Path) -> None:
        """Be a serial port that is found at `path`."""
        if _left_over(path):
            path.unlink()
        if path.exists() or path.is_symlink():
            raise ValueError(f"{path} exists already; give --pty a path that is free")
        if not path.parent.is_dir():
            raise ValueError(f"there is no folder {path.parent} for --pty {path}")
        master, slave = os.openpty()
        # The slave stays open, so that clients may come and go.
        for end in (master, slave):
            self._opened.callback(os.close, end)
        tty.setraw(slave)
        path.symlink_to(os.ttyname(slave))
        self._opened.callback(_unlink, path, os.ttyname(slave))
        self.where = str(path)
        self._selector.register(master, selectors.EVENT_READ, self._read_pty)

    def serve(self) -> None:
        """Serve until `stopped`."""
        try:
            while not self.stopped:
                for key, _ in self._selector.select(LOOK):
                    key.data(key.fileobj)
                self.device.pass_time()
        finally:
            self.close()

    def close(self) -> None:
        """Release the port and whoever uses it; harmless when repeated."""
        for key in list((self._selector.get_map() or {}).values()):
            if isinstance(key.fileobj, socket.socket):
                key.fileobj.close()
        self._selector.close()
        self._opened.close()

    def _accept(self, listener: socket.socket) -> None:
        client, _ = listener.accept()
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._selector.register(client, selectors.EVENT_READ, self._read_client)

    def _read_client(self, client: socket.socket) -> None:
        try:
            data = client.recv(4096)
            if data:
                self._answer(data, client.sendall)
                return
        except (OSError, CutError):
            pass
        self._selector.unregister(client)
        client.close()

    def _read_pty(self, master: int) -> None:
        try:
            self._answer(os.read(master, 4096), lambda reply: os.write(master, reply))
        except CutError:
            self._selector.unregister(master)
            self._opened.close()

    def _answer(self, data: bytes, write: Callable[[bytes], object]) -> None:
        for reply in self.device.heard(data):
            now, strikes = self.device.pass_time(), self.device.faults.strikes
            if strikes(now, "cut"):
                raise CutError
            if strikes(now, "silence"):
                continue
            if strikes(now, "late"):
                time.sleep(LATE)
            if strikes(now, "wrong_crc"):
                reply = reply[:-1] + bytes((reply[-1] ^ 0xFF,))
            if len(reply) > 1 and strikes(now, "split"):
                write(reply[: len(reply) // 2])
                time.sleep(SPLIT)
                reply = reply[len(reply) // 2 :]
            write(reply)


def _left_over(path: Path) -> bool:
    """Whether it is the link of an emulator that was killed."""
    return path.is_symlink() and path.readlink().parent == PTYS and not path.exists()


def _unlink(path: Path, target: str) -> None:
    """Remove a link, unless another has taken its place."""
    if path.is_symlink() and path.readlink() == Path(target):
        path.unlink()
