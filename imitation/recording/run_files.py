"""Where the files of runs lie, how new ones are called, and how they are written whole."""

import os
import re
import shutil
from collections.abc import Callable
from pathlib import Path


def file_in(path: Path, name: str) -> Path:
    """The file of that `name` in a run folder, or `path` itself when it is none."""
    return path / name if path.is_dir() else path


def free(path: Path) -> Path:
    """`path` itself, or the next one that is new."""
    return next_free(path) if path.exists() else path


def next_free(path: Path) -> Path:
    """`path` with the lowest number that makes it a new one; a file's comes before its suffix."""
    suffix = path.suffix if path.is_file() else ""
    name, number = path.name.removesuffix(suffix), 2
    while (new := path.with_name(f"{name}-{number}{suffix}")).exists():
        number += 1
    return new


def write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Have `write` fill a file or folder beside `path`; it becomes `path` when all of it is there.

    Raises:
        OSError: It cannot be written; what was there before is there still.
    """
    unfinished = path.with_name(f".{path.stem}-{os.getpid()}{path.suffix}")
    try:
        _clear_what_was_killed(path)
        write(unfinished)
        unfinished.replace(path)
    except OSError as error:
        error.filename = str(path)  # what was asked for, not the hidden one
        raise
    finally:
        _remove(unfinished)


def _clear_what_was_killed(path: Path) -> None:
    """Remove what processes that were killed left unfinished of `path`."""
    for left in path.absolute().parent.iterdir():
        found = re.fullmatch(rf"\.{re.escape(path.stem)}-(\d+){re.escape(path.suffix)}", left.name)
        if found and not Path("/proc", found[1]).exists():
            _remove(left)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path)
    path.unlink(missing_ok=True)
