"""A Rerun file written by us: Rerun itself hangs, or leaves half a file, when a disk is full."""

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import rerun as rr

BLOCK = 1 << 16  # that is copied at once [bytes]


@contextmanager
def saving(stream: rr.RecordingStream, rrd: Path, blueprint: Any) -> Iterator[None]:
    """What `stream` is told inside goes to the file `rrd`; it is disconnected at the end.

    Raises:
        OSError: The file cannot be written.
    """
    source, sink = os.pipe()
    errors: list[OSError] = []
    copying = threading.Thread(target=_copy, args=(source, rrd, errors))
    copying.start()
    try:
        stream.save(f"/dev/fd/{sink}", default_blueprint=blueprint)
        os.close(sink)
        sink = -1
        yield
    finally:
        if sink >= 0:
            os.close(sink)
        stream.disconnect()
        copying.join()
    if errors:
        raise OSError(errors[0].errno, errors[0].strerror, str(rrd))


def _copy(source: int, rrd: Path, errors: list[OSError]) -> None:
    with open(source, "rb", buffering=0) as told:
        try:
            with rrd.open("wb") as file:
                while block := told.read(BLOCK):
                    file.write(block)
        except OSError as error:
            errors.append(error)
            while told.read(BLOCK):  # Rerun would wait for ever
                pass
