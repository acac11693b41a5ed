"""What can be typed: the groups of conf/, their choices, and what its comments say of each key."""

import re
from functools import cache
from pathlib import Path

from cli.installed_bodies import folders as installed

CONF = Path(__file__).parents[1] / "conf"
LINE = re.compile(r"^(?P<indent> *)(?P<key>\w+):(?P<value>[^#]*)(?:# (?P<comment>.*))?$")
INCLUDED = re.compile(r"^  - (?!_self_)(\w+)$", re.MULTILINE)


@cache
def groups() -> dict[str, list[str]]:
    """Every group with its choices."""
    found = {}
    for folder in sorted(path for path in CONF.iterdir() if path.is_dir()):
        choices = _choices(folder)
        if choices:
            found[folder.name] = choices
    return found


def groups_of(command: str) -> dict[str, list[str]]:
    """The groups that a command's configuration chooses from; of experiments those that fit."""
    text = (CONF / f"{command.replace('-', '_')}.yaml").read_text()
    named = re.findall(r"^  - (?:optional )?(\w+): ", text, re.MULTILINE)
    found = {name: groups()[name] for name in named if name in groups()}
    if "experiment" in found:
        own = {key for name in _files(command) for key in _read(CONF / f"{name}.yaml", "")}
        fitting = [one for one in found["experiment"] if _sets(one) <= own | found.keys()]
        found["experiment"] = fitting
    return found


@cache
def known_targets() -> frozenset[str]:
    """Everything that our configuration, and that of installed bodies, makes parts of."""
    texts = [path.read_text() for folder in (CONF, *installed()) for path in folder.rglob("*.yaml")]
    return frozenset(re.findall(r"^\s*_target_: *(\S+)", "\n".join(texts), re.MULTILINE))


@cache
def comments(command: str) -> dict[str, str]:
    """What conf/ says of each key of a command, by its dotted name."""
    return {key: comment for key, (_, comment) in _lines(command).items()}


def defaults(command: str) -> dict[str, str]:
    """What conf/ sets each key of a command to, as it is written there."""
    return {key: value for key, (value, _) in _lines(command).items()}


def experiments_setting(key: str) -> list[str]:
    """The experiments, of whatever command, that set a key."""
    files = sorted((CONF / "experiment").glob("*.yaml"))
    return [path.stem for path in files if key in _read(path, "")]


def own_keys(command: str) -> list[str]:
    """A command's keys outside its groups, and in those that leave no choice."""
    own, *shared = _files(command)
    lone = [
        (CONF / group / f"{choice}.yaml", group)
        for group, choice in _chosen(CONF / f"{own}.yaml").items()
        if groups().get(group) == [choice]
    ]
    files = [(CONF / f"{own}.yaml", ""), *lone, *((CONF / f"{one}.yaml", "") for one in shared)]
    return [key for path, prefix in files for key in _read(path, prefix)]


def _sets(experiment: str) -> set[str]:
    """The keys and groups that an experiment sets something of."""
    path = CONF / "experiment" / f"{experiment}.yaml"
    overridden = re.findall(r"^  - override /(\w+):", path.read_text(), re.MULTILINE)
    return {*overridden, *(key.partition(".")[0] for key in _read(path, ""))}


@cache
def _lines(command: str) -> dict[str, tuple[str, str]]:
    found: dict[str, tuple[str, str]] = {}
    for group in groups_of(command):
        if group == "experiment":  # its files set keys of the other groups
            continue
        for path in sorted((CONF / group).glob("*.yaml")):
            found |= _read(path, group)
    for name in _files(command):
        found |= _read(CONF / f"{name}.yaml", "")
    return found


def _files(command: str) -> list[str]:
    """The files outside groups that a command is composed of."""
    own = command.replace("-", "_")
    return [own, *INCLUDED.findall((CONF / f"{own}.yaml").read_text())]


def _choices(folder: Path) -> list[str]:
    """Its files, but for those that only others include."""
    chosen = {_chosen(path).get(folder.name) for path in CONF.glob("*.yaml")}
    texts = {path.stem: path.read_text() for path in sorted(folder.glob("*.yaml"))}
    included = {name for text in texts.values() for name in INCLUDED.findall(text)}
    named = {stem for stem, text in texts.items() if re.search(r"^name:", text, re.MULTILINE)}
    return [stem for stem in texts if stem not in included or stem in named | chosen]


def _chosen(path: Path) -> dict[str, str]:
    """What a command's file chooses of each group."""
    return dict(re.findall(r"^  - (\w+): (\w+)", path.read_text(), re.MULTILINE))


def _read(path: Path, prefix: str) -> dict[str, tuple[str, str]]:
    """Value and comment of each key of a YAML file, by its dotted name."""
    found: dict[str, tuple[str, str]] = {}
    above: list[tuple[int, str]] = []
    for line in path.read_text().splitlines():
        match = LINE.match(line)
        if not match or match["key"] in ("defaults", "_target_"):
            continue
        indent = len(match["indent"])
        above = [(depth, key) for depth, key in above if depth < indent] + [(indent, match["key"])]
        dotted = ".".join([prefix, *(key for _, key in above)]).strip(".")
        found[dotted] = (match["value"].strip(), (match["comment"] or "").strip())
    return found
