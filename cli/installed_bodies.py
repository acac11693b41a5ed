"""Bodies that other installed packages bring: their configuration directories."""

from functools import cache
from importlib.metadata import entry_points

GROUP = "imitation.robots"  # each entry point names a package that holds robot/NAME.yaml


@cache
def search_path() -> tuple[str, ...]:
    """The word that lets Hydra find their configurations; none when there are none."""
    packages = sorted({entry.value for entry in entry_points(group=GROUP)})
    if not packages:
        return ()
    return (f"hydra.searchpath=[{','.join(f'pkg://{package}' for package in packages)}]",)
