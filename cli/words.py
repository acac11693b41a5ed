"""The words after a command: KEY=VALUE overrides and Hydra's flags, in the order Hydra wants."""

import re
from dataclasses import dataclass, field
from pathlib import Path

from cli.errors import UserError, nearest, no_such
from cli.keys import CONF, groups

OVERRIDE = re.compile(r"^[+~]*[\w/@.]+=|^~[\w/@.]+$")
PATHS = ("out", "map", "action")  # keys whose values are paths
SPECIAL = re.compile(r"[()\[\]{}=,'\"\\]")
OURS = {"--yes": "confirmed=true", "--dry-run": "dry_run=true"}
SWITCHES = {"-m": "--multirun", "--multirun": "--multirun", "--resolve": "--resolve"}
WITH_VALUE = {
    "--cfg": ("job", "hydra", "all"),
    "-c": ("job", "hydra", "all"),
    "--info": ("all", "config", "defaults", "defaults-tree", "plugins", "searchpath"),
    "--config-dir": (),
    "-cd": (),
    "--package": (),
    "-p": (),
}


@dataclass
class Words:
    """What was typed after the command."""

    overrides: list[str] = field(default_factory=list)
    flags: list[str] = field(default_factory=list)  # Hydra's, with their values

    @property
    def sweep(self) -> bool:
        """Whether several jobs are asked for."""
        return "--multirun" in self.flags

    @property
    def config_dirs(self) -> list[Path]:
        """Folders with configurations of the user's own."""
        given = (flag.partition("=") for flag in self.flags)
        return [Path(value) for name, _, value in given if name == "--config-dir"]

    @property
    def only_shows(self) -> bool:
        """Whether the configuration is to be shown rather than run."""
        return any(flag.startswith(("--cfg=", "--info=")) for flag in self.flags)


def understand(typed: list[str]) -> Words:
    """Sort the words; Hydra wants all overrides in one block before its flags."""
    words, rest = Words(), list(typed)
    while rest:
        word = rest.pop(0)
        name, equals, value = word.partition("=")
        if OVERRIDE.match(word):
            _check_choice(name.lstrip("+"), value)
            words.overrides.append(_absent(name) if value == "null" else word)
        elif word in OURS:
            words.overrides.append(OURS[word])
        elif name in SWITCHES and not equals:
            words.flags.append(SWITCHES[name])
        elif name in WITH_VALUE:
            words.flags.append(_with_value(name, value if equals else _next(name, rest)))
        elif word.startswith("-"):
            # --yes lets a real arm move without asking: nobody should be led to it.
            known = {*SWITCHES, *OURS, *WITH_VALUE, "--help"} - {"--yes"}
            hint = nearest(name, sorted(known)) or ";"
            raise UserError(f"unknown option {name}{hint} keys are typed {name.lstrip('-')}=VALUE")
        else:
            raise UserError(f"expected KEY=VALUE, got {word}; type for instance seed=1")
    if not words.sweep:
        words.overrides = [_path_quoted(word) for word in words.overrides]
    if words.sweep and words.only_shows:
        raise UserError("-m runs a sweep and --cfg or --info only shows: give one of them")
    if "--resolve" in words.flags and not words.only_shows:
        raise UserError("--resolve goes with --cfg: type --cfg job --resolve")
    return words


def quoted(text: str) -> str:
    """`text` as a quoted value of Hydra's grammar."""
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def _path_quoted(word: str) -> str:
    """A word whose path holds what Hydra's grammar gives a meaning, quoted; others as they are."""
    key, _, value = word.partition("=")
    plain = key not in PATHS or not SPECIAL.search(value) or value[:1] in ("'", '"')
    return word if plain else f"{key}={quoted(value)}"


def _check_choice(group: str, choice: str) -> None:
    """Refuse a file that is no choice: others include it."""
    choices = groups().get(group, [])
    if choice not in choices and (CONF / group / f"{choice}.yaml").is_file():
        raise UserError(f"{group}={choice}: {no_such(group, choice, choices)}")


def _absent(key: str) -> str:
    """That nothing of a group takes part; Hydra has another word for it."""
    return f"~{key}" if key in groups() else f"{key}=null"


def _next(name: str, rest: list[str]) -> str:
    if not rest:
        raise UserError(f"{name} needs a value: {' '.join(WITH_VALUE[name]) or 'a name'}")
    return rest.pop(0)


def _with_value(name: str, value: str) -> str:
    choices = WITH_VALUE[name]
    if choices and value not in choices:
        raise UserError(f"{name} takes {', '.join(choices)}; got {value}{nearest(value, choices)}")
    long = {"-c": "--cfg", "-cd": "--config-dir", "-p": "--package"}.get(name, name)
    return f"{long}={value}"
