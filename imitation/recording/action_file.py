"""`action.json`: an action as a timed sequence of visual states, to be read and edited by people.

What is replayed is `area`, `seen_px` and `delay_s`. `centre_px` and `time_s` follow from them: they
may be left out, and must agree where they stand.
"""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from imitation.recording.field_told import LARGEST, told_field, told_size
from imitation.recording.json_lines import LineError, Node, read_json
from imitation.recording.run_files import file_in
from imitation.visual_field import Area, VisualField
from imitation.visual_states import VisualState

VERSION = 1  # of the file's layout
MAX_BYTES = 2**18  # an action of a thousand states is smaller
LATEST = 1e6  # longest time that any demonstration takes [s]
ROUNDING_PX, ROUNDING_S = 0.01, 0.001
LIST = re.compile(r"\[\s+([^\[\]{}]*?)\s+\]")


@dataclass(frozen=True)
class Action:
    """A timed sequence of visual states."""

    field: VisualField
    states: tuple[VisualState, ...]  # two or more

    @classmethod
    def watched(cls, field: VisualField, states: Sequence[VisualState], margin: float) -> "Action":
        """An action as it was watched.

        A hand may rest on a border: its place is told within its area, for others to come there.

        Args:
            field: In which it was watched.
            states: Two or more.
            margin: A place is told at least this far from the border of its area [px].
        """
        inside = (replace(one, place=field.into(one.place, one.area, margin)) for one in states)
        return cls(field, tuple(inside))


def save_action(path: Path, action: Action, made_by: str) -> None:
    """Write an action, with what made it."""
    field, before = action.field, round(action.states[0].time, 3)
    states = []
    for state in action.states:
        time = round(state.time, 3)
        states.append(
            {
                "area": list(state.area),
                "centre_px": field.centres[state.area].round(2).tolist(),
                "seen_px": state.place.round(2).tolist(),
                "time_s": time,
                "delay_s": round(time - before, 3),
            }
        )
        before = time
    geometry = {
        "name": field.name,
        "rows": field.rows,
        "columns": field.columns,
        "left_px": field.left,
        "size_px": list(field.size),
    }
    told = {"version": VERSION, "made_by": made_by, "field": geometry, "states": states}
    path.write_text(LIST.sub(_in_one_line, json.dumps(told, indent=2)) + "\n", encoding="utf-8")


def load_action(path: Path, shortest: float, longest: float) -> Action:
    """Read an action file, or the one in a run folder.

    Args:
        path: Of the file or folder.
        shortest: Time between two states that can be replayed [s].
        longest: The same [s].

    Raises:
        ValueError: There is none, or it says nonsense; the message names the line and a way out.
    """
    file = file_in(path, "action.json")
    if not file.is_file():
        raise ValueError(f"no action at {file}; record one with: imitate demo-record")
    if file.stat().st_size > MAX_BYTES:
        raise ValueError(f"{file} is no action of this program: it is too large")
    try:
        return _action(
            read_json(file.read_text(encoding="utf-8-sig"), "the action"), shortest, longest
        )
    except LineError as error:
        raise ValueError(f"{file}, {error}") from None
    except UnicodeDecodeError:
        raise ValueError(f"{file} is no action of this program: it is no text") from None


def _in_one_line(found: re.Match[str]) -> str:
    return f"[{' '.join(found[1].split())}]"


def _action(root: Node, shortest: float, longest: float) -> Action:
    told = root.keys(("version", "field", "states"), ("made_by",))
    if told["version"].value != VERSION:
        raise told["version"].wrong(f"this program reads version {VERSION}")
    field = _field(told["field"])
    nodes = told["states"].items()
    if len(nodes) < 2:
        raise told["states"].wrong("an action has 2 states or more")
    clock = _Clock(shortest, longest)
    areas = [_area(node, field) for node in nodes]
    states = tuple(
        VisualState(area, _seen(node, field, area), clock.time_of(node))
        for area, node in zip(areas, nodes, strict=True)
    )
    return Action(field, states)


def _field(node: Node) -> VisualField:
    told = node.keys(("name", "rows", "columns", "left_px", "size_px"))
    return told_field(told, told_size(told["size_px"]))


def _state(node: Node) -> dict[str, Node]:
    return node.keys(("area", "seen_px", "delay_s"), ("centre_px", "time_s"))


def _area(node: Node, field: VisualField) -> Area:
    told = _state(node)
    row, column = (
        one.whole(0, count - 1)
        for one, count in zip(told["area"].items(2), field.shape, strict=True)
    )
    centre = field.centres[row, column]
    if "centre_px" in told:
        given = [one.number(0, LARGEST) for one in told["centre_px"].items(2)]
        if np.abs(given - centre).max() > ROUNDING_PX:
            x, y = (f"{value:.2f}".rstrip("0").rstrip(".") for value in centre)
            raise LineError(
                told["centre_px"].line,
                f"centre_px is {given}, but area [{row}, {column}] is centred at [{x}, {y}]; "
                "make them agree, or leave centre_px out",
            )
    return row, column


def _seen(node: Node, field: VisualField, area: Area) -> np.ndarray:
    told = _state(node)["seen_px"]
    pair = told.items(2)
    place = np.array([one.number(0, side) for one, side in zip(pair, field.size, strict=True)])
    if np.abs(field.into(place, area) - place).max() > ROUNDING_PX:
        x_edges, y_edges = field.edges
        (left, right), (top, bottom) = x_edges[area[1] :][:2], y_edges[area[0] :][:2]
        raise told.wrong(
            f"area {list(area)} is x {left:g} to {right:g}, y {top:g} to {bottom:g} px; "
            "make seen_px and area agree"
        )
    return place


class _Clock:
    """Follows the delays, and checks that the times agree with them."""

    def __init__(self, shortest: float, longest: float) -> None:
        self.shortest, self.longest = shortest, longest
        self._now: float | None = None  # time of the state before [s]

    def time_of(self, node: Node) -> float:
        """When a state comes, after those before it [s]."""
        told = _state(node)
        time = told["time_s"].number(0, LATEST) if "time_s" in told else None
        if self._now is None:
            if told["delay_s"].number(0, LATEST) != 0:
                raise told["delay_s"].wrong("nothing comes before the first state: wanted 0")
            self._now = time or 0.0
            return self._now
        before = self._now
        if time is not None and time <= before:
            raise told["time_s"].wrong(f"the state before comes at {before:g} s; times must grow")
        self._now += told["delay_s"].number(self.shortest, self.longest)
        if time is not None and abs(time - self._now) > ROUNDING_S:
            raise LineError(
                told["time_s"].line,
                f"time_s is {time:g}, but the delays until here say {self._now:g}; delay_s is what "
                "is replayed: make them agree, or leave the time_s of all states out",
            )
        return self._now
