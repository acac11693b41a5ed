"""Where the files of runs lie, and how new ones are called: nothing is written over."""

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
