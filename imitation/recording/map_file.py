"""`map.npz`: a visuo-motor map with the fingerprint of the body that learned it."""

import json
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from imitation.arrays import Array
from imitation.gaze import VisualSpace
from imitation.recording.run_files import file_in
from imitation.robot import Body
from imitation.visual_field import VisualField
from imitation.visuo_motor_map import Learning, VisuoMotorMap

VERSION = 1  # of the file's layout
MAX_BYTES = 64 * 2**20  # no map comes near; a larger file is none
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
    try:
        with np.load(file, allow_pickle=False) as stored:
            facts = json.loads(str(stored["facts"]))
            arrays = {name: stored[name] for name in ("postures", "places", "visits", "outline")}
        return _rebuilt(facts, arrays)
    except UNREADABLE as error:
        reason = str(error).splitlines()[0][:120] if str(error) else type(error).__name__
        raise ValueError(f"{file} is no map of this program, or is damaged ({reason})") from error


def _rebuilt(facts: dict[str, Any], arrays: dict[str, Array]) -> LearnedMap:
    if facts["version"] != VERSION:
        raise ValueError(f"map version {facts['version']}, this program reads {VERSION}")
    told = facts["fingerprint"]
    shape, space = told["field"], told["visual_space"]
    width, height = space["size_px"]
    field = VisualField(
        name=shape["name"],
        size=(width, height),
        rows=shape["rows"],
        columns=shape["columns"],
        left=shape["left_px"],
    )
    lower, upper = (np.array(told[key], dtype=float) for key in ("lower_rad", "upper_rad"))
    neurons = int(facts["neurons"])
    cells = (*field.shape, neurons)
    for name, wanted in (
        ("postures", (*cells, len(lower))),
        ("places", (*cells, 2)),
        ("visits", field.shape),
        ("outline", (len(arrays["outline"]), 2)),
    ):
        got = arrays[name]
        if got.shape != wanted or got.dtype.kind not in "fi":
            raise ValueError(f"{name} has shape {got.shape}, wanted {wanted}")
    learned = VisuoMotorMap(field, lower, upper, neurons, Learning(**facts["learning"]))
    learned.postures, learned.places = arrays["postures"], arrays["places"]
    learned.visits = arrays["visits"].astype(np.int64)
    return LearnedMap(learned, arrays["outline"], told)


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
