"""Bodies that other installed packages bring: their configuration directories."""

from functools import cache
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path

GROUP = "imitation.robots"  # each entry point names a package that holds robot/NAME.yaml


@cache
def packages() -> tuple[str, ...]:
    """The packages that hold them."""
    return tuple(sorted({entry.value for entry in entry_points(group=GROUP)}))


def folders() -> list[Path]:
    """Where their files lie."""
    found = (find_spec(package) for package in packages())
    places = [place for spec in found if spec for place in spec.submodule_search_locations or ()]
    return [Path(place) for place in places]


def search_path() -> tuple[str, ...]:
    """The word that lets Hydra find their configurations; none when there are none."""
    if not packages():
        return ()
    return (f"hydra.searchpath=[{','.join(f'pkg://{package}' for package in packages())}]",)
