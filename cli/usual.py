"""What a command's configuration is when little is typed: the default, and that of some choices."""

import re
from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any

from cli.keys import CONF, groups_of


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


def filled(command: str, cfg: Mapping[str, Any]) -> dict[str, Any]:
    """`cfg` with the keys that a later version has added, as they are by default."""
    return _filled(cfg, by_default(command, list(choices(command, cfg))))


def _filled(cfg: Mapping[str, Any], usual: Mapping[str, Any]) -> dict[str, Any]:
    new = dict(cfg)
    if cfg.get("_target_") != usual.get("_target_"):
        return new
    for key, value in usual.items():
        if key not in cfg:
            new[key] = deepcopy(value)
        elif isinstance(value, dict) and isinstance(cfg[key], dict):
            new[key] = _filled(cfg[key], value)
    return new
