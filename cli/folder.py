"""The folder of a run: where it lies, and that nothing is written over."""

import os
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from cli.errors import UserError
from imitation.recording.run_files import next_free

OURS = ("run.mcap", "config.yaml", "metrics.json", "log.txt", "sweep.json", "multirun.yaml")


def make_run_folder(out: str | None, command: str) -> Path:
    """Make the folder `out`, or one named after the time when None.

    Raises:
        UserError: It holds a run already, or cannot be written.
    """
    if out is None:
        return _make_dated(Path("data/runs", command))
    folder = Path(out).expanduser().absolute()
    if _holds_a_run(folder):
        raise UserError(
            f"out={out} holds a run already and nothing is written over; "
            f"type out={next_free(Path(out))}"
        )
    return writable(folder)


def unmake_run_folder(folder: Path) -> None:
    """Take away what a run that never began has left; what else the folder holds stays."""
    for name in OURS:
        (folder / name).unlink(missing_ok=True)
    with suppress(OSError):  # it holds something else
        folder.rmdir()


def check_writable(path: Path, instead: str) -> None:
    """Look whether a file can be written in a folder that is there.

    Raises:
        UserError: It cannot; the message says what to do `instead`.
    """
    if not os.access(path.absolute().parent, os.W_OK | os.X_OK):
        raise UserError(f"{path} cannot be written: its folder is read-only for you; {instead}")


def writable(folder: Path) -> Path:
    """The folder, made when it is missing; whatever it holds stays.

    Raises:
        UserError: It cannot be written.
    """
    absolute = folder.expanduser().absolute()
    _make(absolute, exist_ok=True)
    return absolute


def _holds_a_run(folder: Path) -> bool:
    if not folder.is_dir():
        return False
    return any((folder / name).exists() for name in OURS) or any(folder.glob("*/config.yaml"))


def _make_dated(parent: Path) -> Path:
    folder = (parent / f"{datetime.now():%Y-%m-%d_%H-%M-%S}").absolute()
    while True:
        try:
            _make(folder, exist_ok=False)
        except FileExistsError:
            folder = next_free(folder)
        else:
            return folder


def _make(folder: Path, exist_ok: bool) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=exist_ok)
    except FileExistsError:
        if exist_ok:  # it is a file
            raise UserError(f"out={folder} is a file; name a folder") from None
        raise
    except OSError as error:
        raise UserError(f"out={folder} cannot be made: {error.strerror}") from None
    if not os.access(folder, os.W_OK | os.X_OK):
        raise UserError(f"out={folder} cannot be written: permission denied")
