"""How the configuration of a recorded run differs from the defaults of its command."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from cli.errors import UserError
from cli.recompute import HASHED, configuration
from cli.schema import COMMANDS
from cli.usual import by_default, choices
from imitation.recording.mcap_recording import Recording

NO_SETTING = ("seed", "out")


def settings(recording: Recording) -> list[str]:
    """KEY=VALUE of everything that is not as it is by default in this version."""
    command = recording.metadata["run"].get("command", "")
    if command not in COMMANDS:
        return []
    try:
        cfg = configuration(recording)
    except UserError:
        return []
    chosen = list(choices(command, cfg))
    return chosen + list(otherwise(cfg, by_default(command, chosen)))


def otherwise(cfg: Mapping[str, Any], usual: Mapping[str, Any], above: str = "") -> Iterator[str]:
    """KEY=VALUE of everything in `cfg` that is not so in `usual`."""
    for key, value in cfg.items():
        before = usual.get(key)
        if isinstance(value, dict) and isinstance(before, dict):
            yield from otherwise(value, before, f"{above}{key}.")
        elif value != before and not _is_input(value) and f"{above}{key}" not in NO_SETTING:
            yield f"{above}{key}={json.dumps(value) if not isinstance(value, str) else value}"


def _is_input(value: Any) -> bool:
    return isinstance(value, str) and value.startswith(HASHED)
