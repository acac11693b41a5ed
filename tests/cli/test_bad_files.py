"""Damaged files are told in one line: no traceback, no hang, nothing run from them."""

import shutil
import subprocess
import sys

import pytest
import yaml
from damage import damaged, distorted, positions, to_bytes, to_values
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tampering import counts, rewrite

from cli.explain import explain
from cli.export import export
from cli.inspect import inspect
from cli.reading import reading
from cli.recover import recover_run
from cli.verify import verify
from cli.view import rrd_of

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
    "view": lambda path: rrd_of(path) and 0,
}

DERIVED = (".csv", ".rrd")


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
@given(to_bytes, st.sampled_from(sorted(COMMANDS)))
def test_a_damaged_recording_is_one_line(small, tmp_path, capsys, damage, name):
    check(small, tmp_path / "x", damage, name)
    one_line(capsys)


@pytest.mark.slow
@pytest.mark.timeout(3600)
@settings(max_examples=MANY, **LIMITS)
@given(to_bytes, st.sampled_from(sorted(COMMANDS)))
def test_many_damaged_recordings_are_one_line(small, tmp_path, capsys, damage, name):
    check(small, tmp_path / "x", damage, name)
    one_line(capsys)


@settings(max_examples=EXAMPLES, **LIMITS)
@given(positions, st.integers(0, 255), st.sampled_from(sorted(set(COMMANDS) - {"recover"})))
def test_a_damaged_message_with_right_checksums_is_one_line(
    small, tmp_path, capsys, where, value, name
):
    wanted = int(where * sum(counts(small).values()))
    seen = []

    def change(topic, number, data):
        seen.append(topic)
        if len(seen) != wanted + 1:
            return data
        at = value * 31 % len(data)
        return data[:at] + bytes([value]) + data[at + 1 :]

    rewrite(small, tmp_path / "bad.mcap", change)
    for suffix in DERIVED:
        (tmp_path / "bad").with_suffix(suffix).unlink(missing_ok=True)
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


def check_config(small, folder, damage, name):
    """A configuration that is not as it should be, in a recording that is sound otherwise."""
    folder.mkdir(exist_ok=True)
    path = folder / "run.mcap"
    for suffix in DERIVED:
        path.with_suffix(suffix).unlink(missing_ok=True)

    def attach(one, data):
        if one != "config.yaml":
            return data
        if len(damage) == 3:
            return damaged(data, damage)
        return yaml.safe_dump(distorted(yaml.safe_load(data), damage)).encode()

    rewrite(small, path, attach=attach, sealed=True)
    assert reading(path, lambda: COMMANDS[name](path)) in (0, 1, 2), damage


@settings(max_examples=EXAMPLES // 2, **LIMITS)
@given(to_bytes | to_values, st.sampled_from(sorted(COMMANDS)))
def test_a_damaged_configuration_in_a_recording_is_one_line(small, tmp_path, capsys, damage, name):
    check_config(small, tmp_path / "x", damage, name)
    one_line(capsys)


@pytest.mark.slow
@pytest.mark.timeout(3600)
@settings(max_examples=MANY // 4, **LIMITS)
@given(to_bytes | to_values, st.sampled_from(sorted(COMMANDS)))
def test_many_damaged_configurations_in_recordings(small, tmp_path, capsys, damage, name):
    check_config(small, tmp_path / "x", damage, name)
    one_line(capsys)


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_attachments_are_never_written_where_their_names_say(small, tmp_path, name):
    """Nor is a file anywhere read that a configuration names."""
    tricks = ("../../trick", str(tmp_path / "trick"), "map.npz/../../trick", "..", "a\0b", "")
    (tmp_path / "x").mkdir()

    def attach(one, data):
        if one == "config.yaml":
            return data.replace(b"map: sha256:", b"map: /etc/passwd #")
        return data

    for trick in tricks:
        rewrite(small, tmp_path / "x" / "run.mcap", attach=attach, sealed=True, renamed=trick)
        path = tmp_path / "x" / "run.mcap"
        assert reading(path, lambda path=path: COMMANDS[name](path)) in (0, 2)
        for suffix in DERIVED:
            path.with_suffix(suffix).unlink(missing_ok=True)
    assert {one.name for one in tmp_path.rglob("*")} <= {"x", "run.mcap"}
