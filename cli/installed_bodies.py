"""Bodies that other installed packages bring: their configuration directories."""

from contextlib import suppress
from functools import cache
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path

from cli.errors import say

GROUP = "imitation.robots"  # each entry point names a package that holds robot/NAME.yaml


@cache
def packages() -> tuple[str, ...]:
    """The packages that hold them; one that is not there is told of and left out."""
    named = sorted({entry.module for entry in entry_points(group=GROUP)})
    return tuple(package for package in named if _is_there(package))


def _is_there(package: str) -> bool:
    with suppress(ImportError):
        if find_spec(package):
            return True
    say(f"an installed package has its robots in {package}, which is not there: they are left out")
    return False


def folders() -> list[Path]:
    """Where their files lie."""
    found = (find_spec(package) for package in packages())
    places = [place for spec in found if spec for place in spec.submodule_search_locations or ()]
    return [Path(place) for place in places]


def search_path(*own: str) -> tuple[str, ...]:
    """The word that lets Hydra find their configurations, and those in places of the user's own.

    None when there are none.
    """
    places = [*(f"pkg://{package}" for package in packages()), *own]
    return (f"hydra.searchpath=[{','.join(places)}]",) if places else ()
