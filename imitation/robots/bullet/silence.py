"""Keeps what C code prints off stdout: PyBullet greets whoever imports it."""

import ctypes
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def silence() -> Iterator[None]:
    """Nothing written to the process's stdout inside is seen."""
    libc = ctypes.CDLL(None)
    sys.stdout.flush()
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        libc.fflush(None)  # C keeps what it prints to a pipe until the program ends
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)
