"""What a KEY=VALUE word makes of the configuration of a recorded run."""

from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

from cli.build import Config
from cli.errors import UserError, nearest
from cli.keys import groups_of
from imitation.recording.yaml_reading import read_yaml

# What was sensed cannot be otherwise.
SENSED = (
    *("camera", "robot", "period", "demonstrator", "object", "fault"),
    *("out", "recording", "map", "action"),
)


def replaced(command: str, cfg: Config, words: Sequence[str]) -> Config:
    """`cfg` with the keys of `words` set.

    Raises:
        UserError: A word is not understood, or would change what was sensed.
    """
    new: dict[str, Any] = deepcopy(dict(cfg))
    for word in words:
        key, equals, value = word.partition("=")
        if not equals:
            raise UserError(f"expected KEY=VALUE, got {word}; type for instance dynamics.beta=2")
        if key in SENSED or key.startswith(("camera.", "fault.")):
            raise UserError(f"--with {word}: {key} made the senses, which stay as they were")
        if key in groups_of(command):
            new[key] = _chosen(command, key, value)
        else:
            _set(new, key, _value(word, value))
    return new


def _chosen(command: str, group: str, choice: str) -> Any:
    from cli.experiments import composed

    choices = groups_of(command)[group]
    if choice not in choices:
        raise UserError(f"{group}={choice}: choose from {', '.join(choices)}")
    given = ["map=given"] if command != "learn-map" else []
    return deepcopy(composed(command, *given, f"{group}={choice}")[group])


def _set(cfg: dict[str, Any], dotted: str, value: Any) -> None:
    *above, last = dotted.split(".")
    node: Any = cfg
    for key in above:
        node = node.get(key) if isinstance(node, dict) else None
    if not isinstance(node, dict) or last not in node:
        raise UserError(f"unknown key {dotted}{nearest(dotted, _dotted(cfg, ''))}")
    node[last] = value


def _dotted(cfg: Mapping[str, Any], above: str) -> list[str]:
    found = []
    for key, value in cfg.items():
        found += _dotted(value, f"{above}{key}.") if isinstance(value, dict) else [f"{above}{key}"]
    return found


def _value(word: str, value: str) -> Any:
    try:
        return read_yaml(value)
    except ValueError:
        raise UserError(f"{word} cannot be read: put values that hold brackets in quotes") from None
