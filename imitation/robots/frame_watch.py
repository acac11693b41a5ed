"""Keeps every frame that a device delivers, from a thread, with the time of its capture."""

import threading
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2

from imitation.arrays import Image
from imitation.device import DeviceError
from imitation.robot import SECOND
from imitation.robots.opencv_camera import Development, pictures

PAUSE = 0.2  # before a device that went away is opened again [s]


@dataclass(frozen=True)
class Taken:
    """A frame as it came; times are the wall's [ns]."""

    jpeg: bytes
    time_ns: int  # of its capture
    since_ns: int  # all frames have been equal to it since then


class FrameWatch:
    """Watches a device until it is closed; opens it again when it was away.

    Args:
        device: A number, a device, a URL, or a film, which is shown at its own speed, once.
        develop: Makes JPEGs of its pictures.
        patience: Longest that opening and reading may take [s].
        latency: How long after its capture a frame comes [s].

    Raises:
        DeviceError: The device cannot be opened.
    """

    ended = False  # a film is over

    def __init__(
        self, device: str | int, develop: Development, patience: float, latency: float
    ) -> None:
        self._device, self._develop = device, develop
        self._latency_ns = round(latency * SECOND)
        self._patience_ms = round(1000 * patience)
        self._came, self._taken = threading.Condition(), list[Taken]()
        self._newest: Taken | None = None
        self._closed = threading.Event()
        source = self._open()
        if not source.isOpened():
            raise DeviceError(
                f"camera.device={device} cannot be opened; {_others(device)}type "
                "camera.device=DEVICE or camera.device=http://HOST/STREAM"
            )
        self._thread = threading.Thread(target=self._run, args=(source,), name="camera")
        self._thread.daemon = True
        self._thread.start()

    def take(self) -> list[Taken]:
        """Every frame that came since this was last asked."""
        with self._came:
            taken, self._taken = self._taken, []
        return taken

    def wait_for_one_from(self, time_ns: int, patience: float) -> bool:
        """Wait until a frame was captured at `time_ns` or later; false when none came."""
        with self._came:
            return self._came.wait_for(
                lambda: self._newest is not None and self._newest.time_ns >= time_ns, patience
            )

    def close(self) -> None:
        """Let go of the device; harmless when repeated."""
        self._closed.set()
        self._thread.join(2 * PAUSE)

    def _open(self) -> Any:
        device = str(self._device)
        if device.isdigit():
            return cv2.VideoCapture(int(device))
        if "://" not in device:
            return cv2.VideoCapture(device)
        limits = (cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, cv2.CAP_PROP_READ_TIMEOUT_MSEC)
        settings = [setting for limit in limits for setting in (limit, self._patience_ms)]
        return cv2.VideoCapture(device, cv2.CAP_FFMPEG, settings)

    def _run(self, source: Any) -> None:
        if Path(str(self._device)).is_file():
            self._show(source)
            return
        while not self._closed.is_set():
            there, picture = source.read()
            if there:
                self._keep(picture)
            else:
                source.release()
                self._closed.wait(PAUSE)
                source = self._open()
        source.release()

    def _show(self, film: Any) -> None:
        began = time.monotonic_ns()
        for shown_ns, picture in pictures(film, 0.0, None):
            ahead = began + shown_ns - time.monotonic_ns()
            if self._closed.wait(max(ahead, 0) / SECOND):
                break
            self._keep(picture)
        film.release()
        self.ended = True

    def _keep(self, picture: Image) -> None:
        now = time.monotonic_ns() - self._latency_ns
        jpeg, before = self._develop.jpeg(picture), self._newest
        same = before is not None and before.jpeg == jpeg
        with self._came:
            self._newest = Taken(jpeg, now, before.since_ns if before and same else now)
            self._taken.append(self._newest)
            self._came.notify_all()


def _others(device: str | int) -> str:
    """The cameras that this machine has, for whoever asked for one of them."""
    if "://" in str(device):
        return ""
    found = ", ".join(sorted(map(str, Path("/dev").glob("video*"))))
    return f"this machine has {found}; " if found else "this machine has no camera at /dev/video*; "
