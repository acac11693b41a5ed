"""`map.npz`: a visuo-motor map with the fingerprint of the body that learned it."""

import json
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from imitation.arrays import Array
from imitation.gaze import VisualSpace
from imitation.recording.field_told import LARGEST, told_field, told_size
from imitation.recording.json_lines import Node, read_json
from imitation.recording.run_files import file_in
from imitation.robot import Body
from imitation.visual_field import VisualField
from imitation.visuo_motor_map import Learning, VisuoMotorMap

VERSION = 1  # of the file's layout
MAX_BYTES = 2**23  # no map comes near, packed or not; a larger file is none
MOST_NEURONS = 1000  # in a cluster
ARRAYS = ("postures", "places", "visits", "outline")
FINGERPRINT = ("arm", "joints", "lower_rad", "upper_rad", "field", "visual_space")
# What reading a file that is no map may end in: NumPy, JSON and ZIP each have their own.
UNREADABLE = (
    ArithmeticError,
    EOFError,
    LookupError,
    MemoryError,
    OSError,
    RuntimeError,  # an unknown compression, a password
    TypeError,
    ValueError,
    zipfile.BadZipFile,
    zlib.error,
)


def fingerprint(body: Body, field: VisualField, space: VisualSpace) -> dict[str, Any]:
    """What must be the same where the map is used: arm, limits, field, visual space."""
    return {
        "arm": body.name,
        "joints": list(body.joint_names),
        "lower_rad": body.lower.tolist(),
        "upper_rad": body.upper.tolist(),
        "field": {
            "name": field.name,
            "rows": field.rows,
            "columns": field.columns,
            "left_px": field.left,
        },
        "visual_space": {
            "size_px": list(space.size),
            "focal_px": space.focal,
            "centre_px": list(space.centre),
        },
    }


@dataclass(frozen=True)
class LearnedMap:
    """A map as it was saved."""

    map: VisuoMotorMap
    outline: Array  # convex hull of the places where the hand was seen, (n, 2) [px]
    fingerprint: dict[str, Any]


def save_map(path: Path, stored: LearnedMap) -> None:
    """Write a map."""
    learned = stored.map
    facts = {
        "version": VERSION,
        "fingerprint": stored.fingerprint,
        "learning": learned.learning.__dict__,
        "neurons": learned.neurons,
    }
    np.savez(
        path,
        postures=learned.postures,
        places=learned.places,
        visits=learned.visits,
        outline=stored.outline,
        facts=np.array(json.dumps(facts)),
    )


def load_map(path: Path) -> LearnedMap:
    """Read a map file, or the one in a run folder.

    Raises:
        ValueError: There is none, or it is no map; the message says what to do.
    """
    file = file_in(path, "map.npz")
    if not file.is_file():
        raise ValueError(f"no map at {file}; learn one with: imitate learn-map")
    if file.stat().st_size > MAX_BYTES:
        raise ValueError(f"{file} is no map of this program: it is too large")
    if not zipfile.is_zipfile(file):
        raise ValueError(f"{file} is no map of this program, or was cut; learn-map writes map.npz")
    try:
        _check_unpacked(file)
        with np.load(file, allow_pickle=False) as stored:
            facts = read_json(str(stored["facts"]), "facts")
            arrays = {name: stored[name] for name in ARRAYS}
        return _rebuilt(facts, arrays)
    except UNREADABLE as error:
        reason = str(error).splitlines()[0][:160] if str(error) else type(error).__name__
        raise ValueError(f"{file} is no map of this program, or is damaged ({reason})") from error


def _check_unpacked(file: Path) -> None:
    """Raise an error when what is packed would take more memory than any map."""
    with zipfile.ZipFile(file) as packed:
        if sum(one.file_size for one in packed.infolist()) > MAX_BYTES:
            raise ValueError("what is packed in it is too large")


def _rebuilt(facts: Node, arrays: dict[str, Array]) -> LearnedMap:
    told = facts.keys(("version", "fingerprint", "learning", "neurons"))
    if told["version"].value != VERSION:
        raise told["version"].wrong(f"this program reads version {VERSION}")
    printed = told["fingerprint"].keys(FINGERPRINT)
    lower, upper = _limits(printed)
    space = printed["visual_space"].keys(("size_px", "focal_px", "centre_px"))
    _numbers(space["centre_px"], 2)
    space["focal_px"].number(0, LARGEST * LARGEST)
    field = told_field(
        printed["field"].keys(("name", "rows", "columns", "left_px")), told_size(space["size_px"])
    )
    learned = VisuoMotorMap(
        field, lower, upper, told["neurons"].whole(1, MOST_NEURONS), _learning(told["learning"])
    )
    _check_arrays(arrays, learned)
    learned.postures, learned.places = arrays["postures"], arrays["places"]
    learned.visits = arrays["visits"].astype(np.int64)
    return LearnedMap(learned, arrays["outline"], told["fingerprint"].plain())


def _limits(printed: Mapping[str, Node]) -> tuple[Array, Array]:
    printed["arm"].text()
    joints = [one.text() for one in printed["joints"].items()]
    lower = _numbers(printed["lower_rad"], len(joints))
    upper = _numbers(printed["upper_rad"], len(joints))
    if not joints or not (lower < upper).all():
        raise printed["joints"].wrong("wanted joints, each with a lower limit below its upper one")
    return lower, upper


def _numbers(node: Node, count: int) -> Array:
    return np.array([one.number(-LARGEST, LARGEST) for one in node.items(count)])


def _learning(node: Node) -> Learning:
    names = tuple(Learning.__dataclass_fields__)
    told = {name: one.number(0, LARGEST) for name, one in node.keys(names).items()}
    if not told["excitation"] or not told["inhibition"]:
        raise node.wrong("wanted widths above 0")
    return Learning(**told)


def _check_arrays(arrays: Mapping[str, Array], learned: VisuoMotorMap) -> None:
    shapes = {
        "postures": learned.postures.shape,
        "places": learned.places.shape,
        "visits": learned.visits.shape,
        "outline": (len(np.atleast_1d(arrays["outline"])), 2),
    }
    for name, wanted in shapes.items():
        got = arrays[name]
        if got.shape != wanted or got.dtype != (np.int64 if name == "visits" else np.float64):
            raise ValueError(f"{name} is {got.dtype} of shape {got.shape}, wanted shape {wanted}")
        if np.any(np.isinf(got)) or np.any(np.abs(got) > LARGEST * LARGEST):
            raise ValueError(f"{name} holds numbers that no map holds")
    empty = np.isnan(arrays["postures"])
    both = np.isnan(arrays["places"]).any(axis=-1)
    if not (empty.all(axis=-1) == empty.any(axis=-1)).all() or (both != empty[..., 0]).any():
        raise ValueError("a posture or its place is not a number")
    if np.isnan(arrays["outline"]).any():
        raise ValueError("the outline is not of numbers")


def differences(learned: dict[str, Any], present: dict[str, Any]) -> list[str]:
    """What a map's fingerprint and the present body do not share, in words."""
    found = []
    if learned["arm"] != present["arm"]:
        found.append(f"it was learned on the arm {learned['arm']}, this one is {present['arm']}")
    elif learned["joints"] != present["joints"]:
        found.append(f"it has the joints {learned['joints']}, this arm has {present['joints']}")
    else:
        found += [
            f"its joint limits ({key}) are not this arm's"
            for key in ("lower_rad", "upper_rad")
            if not np.allclose(learned[key], present[key], rtol=0, atol=1e-6)
        ]
    if learned["visual_space"] != present["visual_space"]:
        found.append(
            f"its visual space is {learned['visual_space']}, this camera's is "
            f"{present['visual_space']}"
        )
    return found
