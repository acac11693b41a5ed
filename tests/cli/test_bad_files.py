"""Damaged files are told in one line: no traceback, no hang, nothing run from them."""

import shutil
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from cli.explain import explain
from cli.export import export
from cli.inspect import inspect
from cli.reading import reading
from cli.recover import recover_run
from cli.verify import verify

EXAMPLES = 40  # damaged recordings in the usual tests
MANY = 2000  # in all of them
LIMITS = {
    "deadline": None,
    "suppress_health_check": [HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
}
COMMANDS = {
    "inspect": lambda path: inspect(path, as_json=True),
    "verify": verify,
    "explain": lambda path: explain(path, 0.1),
    "recover": recover_run,
    "export": lambda path: export([path, path.with_suffix(".csv")], "csv"),
}

positions = st.floats(0, 1, exclude_max=True)
damages = st.one_of(
    st.tuples(st.just("cut"), positions, st.just(0)),
    st.tuples(st.just("flip"), positions, st.integers(0, 7)),
    st.tuples(st.just("huge"), positions, st.integers(1, 8)),
    st.tuples(st.just("zero"), positions, st.integers(1, 5000)),
    st.tuples(st.just("insert"), positions, st.integers(1, 50)),
)


def damaged(data, damage):
    """`data` with a damage done to it."""
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


@pytest.fixture(scope="module")
def small(learned, tmp_path_factory):
    """A recording of a few steps: not to be changed."""
    from typer.testing import CliRunner

    from cli.main import app

    folder = tmp_path_factory.mktemp("small") / "run"
    words = ["robot=ideal", "reach.limit=1.2", "reach.required=0", "controller=yuragi"]
    CliRunner().invoke(app, ["reach", *words, f"map={learned}", f"out={folder}"])
    return folder / "run.mcap"


def check(small, folder, damage, name):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    path = folder / "run.mcap"
    path.write_bytes(damaged(small.read_bytes(), damage))
    code = reading(path, lambda: COMMANDS[name](path))
    assert code in (0, 1, 2), damage


def one_line(capsys):
    told = capsys.readouterr().err
    assert "Traceback" not in told, told


@settings(max_examples=EXAMPLES, **LIMITS)
@given(damages, st.sampled_from(sorted(COMMANDS)))
def test_a_damaged_recording_is_one_line(small, tmp_path, capsys, damage, name):
    check(small, tmp_path / "x", damage, name)
    one_line(capsys)


@pytest.mark.slow
@pytest.mark.timeout(3600)
@settings(max_examples=MANY, **LIMITS)
@given(damages, st.sampled_from(sorted(COMMANDS)))
def test_many_damaged_recordings_are_one_line(small, tmp_path, capsys, damage, name):
    check(small, tmp_path / "x", damage, name)
    one_line(capsys)


@settings(max_examples=EXAMPLES, **LIMITS)
@given(positions, st.integers(0, 255), st.sampled_from(sorted(set(COMMANDS) - {"recover"})))
def test_a_damaged_message_with_right_checksums_is_one_line(
    small, tmp_path, capsys, where, value, name
):
    from tampering import counts, rewrite

    wanted = int(where * sum(counts(small).values()))
    seen = []

    def change(topic, number, data):
        seen.append(topic)
        if len(seen) != wanted + 1:
            return data
        at = value * 31 % len(data)
        return data[:at] + bytes([value]) + data[at + 1 :]

    rewrite(small, tmp_path / "bad.mcap", change)
    (tmp_path / "bad.csv").unlink(missing_ok=True)
    path = tmp_path / "bad.mcap"
    assert reading(path, lambda: COMMANDS[name](path)) in (0, 1, 2)
    one_line(capsys)


def test_memory_stays_small(small, tmp_path):
    """A chunk that claims to hold gigabytes is refused before they are taken."""
    data = bytearray(small.read_bytes())
    at = data.index(b"zstd") - 4 - 8  # size of the chunk's content, before its checksum
    data[at - 4 : at + 4] = (1 << 40).to_bytes(8, "little")
    (tmp_path / "run.mcap").write_bytes(data)
    code = (
        "import sys, resource; from cli.main import main\n"
        "try: main()\n"
        "finally: print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    )
    call = [sys.executable, "-c", code, "inspect", str(tmp_path / "run.mcap")]
    told = subprocess.run(call, capture_output=True, text=True, check=False)
    assert told.returncode == 2 and len(told.stderr.splitlines()) == 1, told.stderr
    assert int(told.stdout.split()[-1]) < 1_000_000  # kB
