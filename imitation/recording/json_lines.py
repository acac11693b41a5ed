"""JSON whose values know the line they stand in, so that what is wrong can be told there."""

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

# Of a text that is JSON, commas and colons tell nothing that the order does not.
TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[{}\[\]]|[^\s{}\[\],:"]+')


class LineError(ValueError):
    """What is wrong, and in which line."""

    def __init__(self, line: int, sentence: str) -> None:
        super().__init__(f"line {line}: {sentence}")


@dataclass(frozen=True)
class Node:
    """One value, with checks that say what was wanted and what came."""

    name: str
    value: Any  # nodes in a list or a dict; otherwise as JSON has it
    line: int

    def wrong(self, wanted: str) -> LineError:
        """The error to raise."""
        return LineError(self.line, f"{self.name} is {_told(self.value)}; {wanted}")

    def keys(self, needed: Sequence[str], also: Sequence[str] = ()) -> dict[str, "Node"]:
        """The values of an object that has the `needed` keys, and none but those and `also`."""
        known = ", ".join((*needed, *also))
        if not isinstance(self.value, dict):
            raise self.wrong(f"wanted an object {{...}} with the keys {known}")
        for key, node in self.value.items():
            if key not in (*needed, *also):
                raise LineError(node.line, f"unknown key {key}; the keys are {known}")
        for key in needed:
            if key not in self.value:
                raise LineError(self.line, f"{self.name} that begins here lacks {key}")
        return self.value

    def items(self, count: int | None = None) -> list["Node"]:
        """The values of a list, of `count` values if given."""
        if not isinstance(self.value, list) or count not in (None, len(self.value)):
            raise self.wrong(f"wanted a list of {count} values" if count else "wanted a list [...]")
        return self.value

    def number(self, low: float, high: float) -> float:
        """A number from `low` to `high`."""
        value, span = self.value, f"wanted a number from {low:g} to {high:g}"
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self.wrong(span)
        if not low <= value <= high:  # nan is not either
            raise self.wrong(span)
        return float(value)

    def whole(self, low: int, high: int) -> int:
        """A whole number from `low` to `high`."""
        value, span = self.value, f"wanted a whole number from {low} to {high}"
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise self.wrong(span)
        return value

    def text(self) -> str:
        """A text."""
        if not isinstance(self.value, str):
            raise self.wrong('wanted a text "..."')
        return self.value

    def plain(self) -> Any:
        """The value without the lines."""
        if isinstance(self.value, dict):
            return {key: node.plain() for key, node in self.value.items()}
        if isinstance(self.value, list):
            return [node.plain() for node in self.value]
        return self.value


def read_json(text: str, name: str) -> Node:
    """The whole of a JSON text; `name` stands for it in errors.

    Raises:
        LineError: It is not JSON, or says a key twice.
    """
    try:
        json.loads(text)
        tokens = _tokens(text)
        return _node(name, *next(tokens), tokens)
    except json.JSONDecodeError as error:
        raise LineError(error.lineno, f"not valid JSON: {error.msg}") from None
    except RecursionError:
        raise LineError(1, "not valid JSON: nested too deeply") from None
    except LineError:
        raise
    except ValueError as error:  # a number of thousands of digits
        raise LineError(1, f"not valid JSON: {error}") from None


def _tokens(text: str) -> Iterator[tuple[str, int]]:
    for number, line in enumerate(text.split("\n"), start=1):
        for token in TOKEN.findall(line):
            yield token, number


def _node(name: str, token: str, line: int, rest: Iterator[tuple[str, int]]) -> Node:
    if token == "[":
        listed: list[Node] = []
        for one, its_line in rest:
            if one == "]":
                break
            listed.append(_node(f"{name}[{len(listed)}]", one, its_line, rest))
        return Node(name, listed, line)
    if token == "{":
        found: dict[str, Node] = {}
        for one, its_line in rest:
            if one == "}":
                break
            key = json.loads(one)
            if key in found:
                raise LineError(its_line, f"{key} is said a second time")
            found[key] = _node(key, *next(rest), rest)
        return Node(name, found, line)
    return Node(name, json.loads(token), line)


def _told(value: Any) -> str:
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return f"a list of {len(value)} values"
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 40 else f"{text[:37]}..."
