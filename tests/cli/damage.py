"""Damage to files, as a disk, an editor or somebody hostile does it."""

import io
import json
import zipfile
from copy import deepcopy

import numpy as np
from hypothesis import strategies as st

positions = st.floats(0, 1, exclude_max=True)
to_bytes = st.one_of(
    st.tuples(st.just("cut"), positions, st.just(0)),
    st.tuples(st.just("flip"), positions, st.integers(0, 7)),
    st.tuples(st.just("huge"), positions, st.integers(1, 8)),
    st.tuples(st.just("zero"), positions, st.integers(1, 5000)),
    st.tuples(st.just("insert"), positions, st.integers(1, 50)),
)
# What may stand where something else was expected.
ODD = (
    *(None, True, False, 0, -1, 1, 2.5, 1e308, -1e308, float("inf"), float("nan"), 10**30, 10**9),
    *("", "x", "9" * 5000, "../../../../etc/passwd", "\x00", "sha256:", "é" * 300, "${seed}"),
    *([], [[]], {}, [0] * 1000, [1, "x"], [float("nan")] * 3, {"_target_": "os.system"}, {"": {}}),
)
NUMBERS = [one for one in ODD if isinstance(one, int | float)]
to_values = st.tuples(positions, st.sampled_from(range(len(ODD) + 2)))


def damaged(data, damage):
    """`data` with a damage done to its bytes."""
    kind, where, how = damage
    at, data = int(where * len(data)), bytearray(data)
    if kind == "cut":
        return bytes(data[:at])
    if kind == "flip":
        data[at] ^= 1 << how
    elif kind == "huge":
        data[at : at + how] = b"\xff" * how
    elif kind == "zero":
        data[at : at + how] = bytes(len(data[at : at + how]))
    else:
        data[at:at] = np.random.default_rng(how).bytes(how)
    return bytes(data)


def distorted(tree, damage):
    """`tree` of dicts and lists with one value in it replaced, taken away or said twice."""
    where, how = damage
    tree = deepcopy(tree)
    places = list(_places(tree))
    holder, key = places[int(where * len(places))]
    if how < len(ODD):
        holder[key] = deepcopy(ODD[how])
    elif how == len(ODD):
        del holder[key]
    elif isinstance(holder, dict):
        holder[f"{key}x"] = holder.pop(key)
    else:
        holder.append(holder[key])
    return tree


def _places(node):
    """Every holder and key below `node`."""
    for key in list(node) if isinstance(node, dict) else range(len(node)):
        yield node, key
        if isinstance(node[key], dict | list):
            yield from _places(node[key])


def distorted_map(data, damage):
    """A map whose facts or one of whose arrays is not as it should be, in a sound file."""
    where, how = damage
    with np.load(io.BytesIO(data)) as stored:
        arrays = dict(stored)
    names = sorted(arrays)
    name = names[int(where * len(names))]
    rest = where * len(names) % 1
    if name == "facts" or how % 3 == 0:
        told = distorted(json.loads(str(arrays["facts"])), (rest, how))
        arrays["facts"] = np.array(json.dumps(told))
    else:
        arrays[name] = _distorted_array(arrays[name], int(rest * 1000), how)
    packed = io.BytesIO()
    np.savez(packed, **arrays)
    return packed.getvalue()


def _distorted_array(array, at, how):
    if how % 3 == 1:
        value = float(NUMBERS[how % len(NUMBERS)])
        other = array.astype(np.float64)
        other.flat[at % array.size] = value
        whole = array.dtype.kind == "i" and np.isfinite(value) and abs(value) < 1e18
        return other.astype(array.dtype) if whole else other
    shapes = [array[:-1], array.ravel(), array[None], array[..., :0], array.astype(np.complex64)]
    shapes += [array.astype("S8"), array.astype(np.float16), array.astype(bool), np.array(3.0)]
    return shapes[at % len(shapes)]


def packed_bomb(data, member, content, megabytes):
    """A map with other `content` in one `member`, and zeros that are packed small beside it."""
    packed = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(packed, "w") as new:
        for name in old.namelist():
            new.writestr(name, content if name == member else old.read(name))
        if megabytes:
            with new.open(_deflated("bomb.npy"), "w", force_zip64=True) as out:
                for _ in range(megabytes):
                    out.write(bytes(2**20))
    return packed.getvalue()


def _deflated(name):
    told = zipfile.ZipInfo(name)
    told.compress_type = zipfile.ZIP_DEFLATED
    return told
