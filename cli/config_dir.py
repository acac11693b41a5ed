"""What a user's own configuration files may hold, looked at before Hydra reads them."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from cli.errors import UserError
from cli.keys import known_targets
from imitation.recording.yaml_reading import MOST_LETTERS, read_yaml

WHERE = ("*.yaml", "*/*.yaml", "hydra/*/*.yaml")  # configurations and their groups
MOST_COMPUTED = 40  # values with ${...} in all files: of each other, they would grow without end
HYDRA = ("hydra_plugins.", "hydra._internal.")  # what launchers and sweepers are


def check_config_dir(folder: Path) -> None:
    """Refuse a folder with a file that is not YAML, would run code or become large.

    Raises:
        UserError: It holds one, or is no folder; the message names it.
    """
    if not folder.is_dir():
        raise UserError(f"--config-dir: {folder} is no folder")
    computed = 0
    for path in sorted(path for pattern in WHERE for path in folder.glob(pattern)):
        try:
            computed += _checked(path)
        except OSError as error:
            raise UserError(f"{path} cannot be read: {error.strerror}") from None
        except ValueError as error:
            raise UserError(f"{path}, {error}") from None
        if computed > MOST_COMPUTED:
            raise UserError(f"{path}: too many values are computed by ${{...}}; write them out")


def _checked(path: Path) -> int:
    """How many values of a file are computed."""
    if path.stat().st_size > MOST_LETTERS:
        raise ValueError("too large for a configuration")
    text = path.read_bytes()
    for target in values("_target_", read_yaml(text)):
        if target not in known_targets() and not target.startswith(HYDRA):
            raise ValueError(not_known(target))
    return text.count(b"${")


def not_known(target: str) -> str:
    """That nothing of this name is called."""
    return (
        f"_target_: {target} is no part of this program, nor of an installed package that brings "
        "an arm (docs/own_arm.md)"
    )


def values(key: str, node: Any) -> Iterator[str]:
    """What stands behind `key` anywhere in a configuration."""
    if isinstance(node, dict):
        for name, value in node.items():
            yield from [str(value)] if name == key else values(key, value)
    elif isinstance(node, list):
        for value in node:
            yield from values(key, value)
