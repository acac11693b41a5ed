"""YAML as plain values: what a file may hold is bounded before any of it is made."""

import re
from typing import Any

import yaml

MOST_LETTERS = 2**17  # no configuration comes near
MOST_VALUES = 2**15  # with every alias replaced by what it stands for
DEEPEST = 50  # lists and mappings within each other
MOST_BRACKETS = 2**11  # those that are never closed cost the square of their number
QUICK = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
BEGIN = (yaml.SequenceStartEvent, yaml.MappingStartEvent)
END = (yaml.SequenceEndEvent, yaml.MappingEndEvent)

# What a value that is none of its type may end in: PyYAML does not look before it reads.
UNREADABLE = (
    yaml.YAMLError,
    ArithmeticError,
    AttributeError,
    LookupError,
    RecursionError,
    TypeError,
    ValueError,
)


def read_yaml(text: str | bytes) -> Any:
    """What a YAML text says.

    Raises:
        ValueError: It is not YAML, names a Python object, or says too much.
    """
    check_size(text)
    try:
        return yaml.load(text, Loader=QUICK)
    except UNREADABLE as error:
        raise ValueError(_told(error)) from None


def check_size(text: str | bytes) -> None:
    """Refuse a text that would become large or deep, such as aliases of aliases of aliases.

    Raises:
        ValueError: It would, or it is not YAML.
    """
    if len(text) > MOST_LETTERS:
        raise ValueError("too large for a configuration")
    if len(re.findall(r"[\[{]", str(text))) > MOST_BRACKETS:
        raise ValueError("too many values, or too deep, for a configuration")
    try:
        _count(text)
    except (yaml.YAMLError, UnicodeError) as error:
        raise ValueError(_told(error)) from None


def _count(text: str | bytes) -> None:
    sizes: dict[str, int] = {}  # of what each anchor stands for
    opened: list[tuple[str | None, int]] = [(None, 0)]  # anchor and size of all that is not closed
    for event in yaml.parse(text, Loader=QUICK):
        if isinstance(event, BEGIN):
            opened.append((event.anchor, 1))
            continue
        if isinstance(event, END):
            anchor, size = opened.pop()
        elif isinstance(event, yaml.AliasEvent):
            if event.anchor not in sizes:
                raise ValueError(f"not valid YAML: *{event.anchor} stands for nothing before it")
            anchor, size = None, sizes[event.anchor]
        elif isinstance(event, yaml.ScalarEvent):
            anchor, size = event.anchor, 1
        else:
            continue
        if anchor is not None:
            sizes[anchor] = size
        above, count = opened.pop()
        opened.append((above, count + size))
        if count + size > MOST_VALUES or len(opened) > DEEPEST:
            raise ValueError("too many values, or too deep, for a configuration")


def _told(error: Exception) -> str:
    problem = str(getattr(error, "problem", None) or error) or type(error).__name__
    mark = getattr(error, "problem_mark", None)
    where = f"line {mark.line + 1}: " if mark else ""
    return f"{where}not valid YAML: {problem.splitlines()[0][:120]}"
