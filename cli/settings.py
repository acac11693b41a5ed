"""How the configuration of a recorded run differs from the defaults of its command."""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from cli.errors import UserError
from cli.keys import CONF, groups_of
from cli.recompute import HASHED, configuration
from cli.schema import COMMANDS
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


def by_default(command: str, words: Sequence[str]) -> Mapping[str, Any]:
    """A command's configuration when nothing but `words` is typed."""
    from cli.experiments import composed

    files = [CONF / f"{command.replace('-', '_')}.yaml"]
    files += [CONF / f"{word.replace('=', '/')}.yaml" for word in words]
    needed = [f"{above}{key}=given" for file, above in _above(files) for key in missing_in(file)]
    return composed(command, *words, *needed)


def choices(command: str, cfg: Mapping[str, Any]) -> Iterator[str]:
    """GROUP=CHOICE where another choice than the default one was made."""
    usual = by_default(command, [])
    for group, known in groups_of(command).items():
        now, before = cfg.get(group), usual.get(group)
        for key in ("name", "_target_"):
            if isinstance(now, dict) and isinstance(before, dict) and key in now:
                if now[key] != before.get(key):
                    yield from (f"{group}={one}" for one in known if says(group, one, key, now))
                break


def says(group: str, choice: str, key: str, now: Mapping[str, Any]) -> bool:
    """Whether a choice's file sets `key` as it is `now`."""
    line = f"\n{key}: {now[key]}"
    text = (CONF / group / f"{choice}.yaml").read_text()
    return f"{line}\n" in text or f"{line} #" in text


def missing_in(file: Path) -> list[str]:
    """Keys of a YAML file that have to be given."""
    return re.findall(r"^(\w+): \?\?\?", file.read_text(), re.MULTILINE)


def _above(files: Sequence[Path]) -> Iterator[tuple[Path, str]]:
    for file in files:
        yield file, "" if file.parent == CONF else f"{file.parent.name}."


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
