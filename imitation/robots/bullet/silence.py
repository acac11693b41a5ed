"""Keeps what C code prints off the terminal: PyBullet greets whoever imports it."""

import ctypes
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

STREAMS = (1, 2)  # stdout and stderr of the process


@contextmanager
def silence() -> Iterator[None]:
    """Nothing written to the process's stdout and stderr inside is seen."""
    libc = ctypes.CDLL(None)
    sys.stdout.flush()
    sys.stderr.flush()
    kept, nowhere = [os.dup(stream) for stream in STREAMS], os.open(os.devnull, os.O_WRONLY)
    for stream in STREAMS:
        os.dup2(nowhere, stream)
    try:
        yield
    finally:
        libc.fflush(None)  # C keeps what it prints to a pipe until the program ends
        for stream, copy in zip(STREAMS, kept, strict=True):
            os.dup2(copy, stream)
            os.close(copy)
        os.close(nowhere)
