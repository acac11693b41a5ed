"""Damaged maps, actions and configurations are told in one line too, and nothing in them is run."""

import io
import json
import subprocess
import sys
import warnings
from itertools import islice
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
from damage import damaged, distorted, distorted_map, packed_bomb, to_bytes, to_values
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from cli import stages
from cli.build import Bench
from cli.config_dir import check_config_dir
from cli.experiments import composed
from cli.job import attempt
from cli.jobs.reach import the_map, trials_of
from cli.jobs.replay import deferred_metrics, the_action
from cli.replaying import replaying
from cli.trouble import as_user_error

SOME, MANY = 40, 600  # damaged files of each kind: in the usual tests, in all of them
SUPPRESSED = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
LIMITS = {"deadline": None, "suppress_health_check": SUPPRESSED}
STEPS = 3  # that are made with what was read
MEASURED = (
    "import sys, resource; from cli.main import main\n"
    "try: main()\n"
    "finally: print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
)


def told_in_one_line(action, capsys):
    """Whatever `action` reads, it is used, or refused in one line; warnings are lines too."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        code = attempt(action)
    told = capsys.readouterr().err
    assert (code, len(told.splitlines())) in ((0, 0), (2, 1)), told
    return told


def run_of(command, **inputs):
    """Just enough of a run to read its inputs."""
    given_words = [f"{key}=given" for key in inputs]
    cfg = {**composed(command, *given_words, "robot=ideal"), **inputs}
    return SimpleNamespace(cfg=cfg, bench=Bench(cfg), uses=lambda key, path: None)


def reach_with(path):
    """A few steps of reaching with a map."""
    run = run_of("reach", map=str(path))
    stored = the_map(run)
    list(islice(stages.reaching(run.bench, stored.map, trials_of(run.bench, stored)), STEPS))
    return 0


def replay_with(learned, path):
    """A few steps of replaying an action."""
    run = run_of("replay", map=str(learned), action=str(path))
    stored, action = the_map(run), the_action(run)
    deferred_metrics(run.bench, stored.map, action)
    list(islice(replaying(run.bench, stored.map, action)[1], STEPS))
    return 0


def learn_with(folder, *words):
    """A few steps of learning with configurations of the user's own."""
    check_config_dir(folder)
    try:
        cfg = composed.__wrapped__("learn-map", f"hydra.searchpath=['file://{folder}']", *words)
    except Exception as error:
        raise as_user_error("learn-map", error) from error
    list(islice(stages.learning(Bench(cfg))[1], STEPS))
    return 0


@pytest.fixture(scope="module")
def action(ran):
    """Text of an action."""
    return (ran("demo-record") / "action.json").read_text()


def check_map(learned, tmp_path, capsys, damage):
    whole = (learned / "map.npz").read_bytes()
    distort = distorted_map if len(damage) == 2 else damaged
    (tmp_path / "bad.npz").write_bytes(distort(whole, damage))
    told_in_one_line(lambda: reach_with(tmp_path / "bad.npz"), capsys)


def check_action(learned, action, tmp_path, capsys, damage):
    if len(damage) == 2:
        text = json.dumps(distorted(json.loads(action), damage)).encode()
    else:
        text = damaged(action.encode(), damage)
    (tmp_path / "bad.json").write_bytes(text)
    told_in_one_line(lambda: replay_with(learned, tmp_path / "bad.json"), capsys)


CONFIGS = {  # group: what precedes the text of one
    "robot": "",
    "experiment": "# @package _global_\n",
}


def check_config(tmp_path, capsys, group, damage):
    whole = composed("learn-map", "robot=ideal")
    own = {
        key: whole[key] for key in ("period", "recording", "camera", "vision", "map", "curiosity")
    }
    tree = whole["robot"] if group == "robot" else own
    for one in CONFIGS:
        (tmp_path / one).mkdir(exist_ok=True)
        (tmp_path / one / "bad.yaml").unlink(missing_ok=True)
    tree = distorted(tree, damage) if len(damage) == 2 else tree
    text = (CONFIGS[group] + yaml.safe_dump(tree, allow_unicode=True)).encode()
    text = text if len(damage) == 2 else damaged(text, damage)
    (tmp_path / group / "bad.yaml").write_bytes(text)
    body = [] if group == "robot" else ["robot=ideal"]
    told_in_one_line(lambda: learn_with(tmp_path, *body, f"{group}=bad"), capsys)


damages = to_bytes | to_values


@settings(max_examples=SOME, **LIMITS)
@given(damages)
def test_a_damaged_map_is_one_line(learned, tmp_path, capsys, damage):
    check_map(learned, tmp_path, capsys, damage)


@settings(max_examples=SOME, **LIMITS)
@given(damages)
def test_a_damaged_action_is_one_line(learned, action, tmp_path, capsys, damage):
    check_action(learned, action, tmp_path, capsys, damage)


@settings(max_examples=SOME // 4, **LIMITS)
@given(st.sampled_from(sorted(CONFIGS)), damages)
def test_a_damaged_configuration_is_one_line(tmp_path, capsys, group, damage):
    check_config(tmp_path, capsys, group, damage)


@pytest.mark.slow
@pytest.mark.timeout(1200)
@settings(max_examples=MANY, **LIMITS)
@given(damages)
def test_many_damaged_maps_are_one_line(learned, tmp_path, capsys, damage):
    check_map(learned, tmp_path, capsys, damage)


@pytest.mark.slow
@pytest.mark.timeout(1200)
@settings(max_examples=MANY, **LIMITS)
@given(damages)
def test_many_damaged_actions_are_one_line(learned, action, tmp_path, capsys, damage):
    check_action(learned, action, tmp_path, capsys, damage)


@pytest.mark.slow
@pytest.mark.timeout(2400)
@settings(max_examples=MANY, **LIMITS)
@given(st.sampled_from(sorted(CONFIGS)), damages)
def test_many_damaged_configurations_are_one_line(tmp_path, capsys, group, damage):
    check_config(tmp_path, capsys, group, damage)


def bombs():
    """Texts of YAML that would take all memory, run something or never end, by what is said."""
    lol = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n"
    lol += "".join(f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 10))
    sums = "v0: xxxxxxxxxx\n" + "".join(f"v{i}: ${{v{i - 1}}}${{v{i - 1}}}\n" for i in range(1, 41))
    return {
        "too many values": lol,
        "stands for nothing": "a: &a [*a]\n",
        "too deep": "- " * 10_000,
        "too large": "a: 1\n" * 100_000,
        "computed": sums,
        "could not determine a constructor": "a: !!python/object/apply:os.system ['touch ran']\n",
        "os.system": "arm:\n  _target_: os.system\n  command: touch ran\n",
        "subprocess.run": "hydra:\n  callbacks:\n    x:\n      _target_: subprocess.run\n",
        "not valid YAML": "a: 2001-99-99 00:00:00\nb: [\n",
    }


@pytest.mark.parametrize("says", bombs())
def test_a_configuration_that_would_run_or_grow_is_refused(imitate, tmp_path, says):
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "bad.yaml").write_text(bombs()[says])
    told = imitate("learn-map", "robot=bad", "--config-dir", str(tmp_path))
    assert told.exit_code == 2 and len(told.stderr.splitlines()) == 1, told.output
    assert says in told.stderr and "bad.yaml" in told.stderr
    assert not (tmp_path / "ran").exists()


def header_of(shape, kind="<f8"):
    """The head of a .npy that claims a shape."""
    out = io.BytesIO()
    told = {"descr": kind, "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(out, told)
    return out.getvalue()


HUGE = {
    "shape": ("postures.npy", header_of((2**40,)), 0),
    "overflow": ("postures.npy", header_of((2**31, 2**31, 2**31)), 0),
    "text": ("facts.npy", header_of((), f"<U{2**29 - 1}"), 0),
    "header": ("facts.npy", b"\x93NUMPY\x02\x00\xff\xff\xff\xff" * 9, 0),
    "zeros": ("visits.npy", header_of((4,)) + bytes(32), 1500),
}
SLOW = [pytest.param(name, marks=pytest.mark.slow) for name in HUGE if name != "shape"]


@pytest.mark.parametrize("name", ["shape", *SLOW])
def test_a_map_that_claims_to_be_huge_takes_no_memory(learned, tmp_path, name):
    whole = (learned / "map.npz").read_bytes()
    (tmp_path / "bad.npz").write_bytes(packed_bomb(whole, *HUGE[name]))
    call = [sys.executable, "-c", MEASURED, "reach", "robot=ideal", f"map={tmp_path / 'bad.npz'}"]
    told = subprocess.run(call, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert told.returncode == 2 and len(told.stderr.splitlines()) == 1, told.stderr
    assert int(told.stdout.split()[-1]) < 1_000_000  # kB


@pytest.mark.slow
def test_an_action_that_claims_to_be_huge_takes_no_memory(learned, action, tmp_path):
    told = json.loads(action)
    told["field"] |= {"rows": 10_000, "columns": 10_000, "size_px": [10_000, 10_000]}
    (tmp_path / "bad.json").write_text(json.dumps(told))
    call = [sys.executable, "-c", MEASURED, "replay", "robot=ideal", f"map={learned}"]
    call += [f"action={tmp_path / 'bad.json'}"]
    told = subprocess.run(call, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert told.returncode == 2 and len(told.stderr.splitlines()) == 1, told.stderr
    assert int(told.stdout.split()[-1]) < 1_000_000  # kB


@settings(max_examples=SOME, **LIMITS)
@given(st.text() | st.binary())
@example("{[}]" * 1000)
def test_any_text_is_no_action_and_no_map(learned, tmp_path, capsys, text):
    data = text.encode(errors="surrogatepass") if isinstance(text, str) else text
    for name, use in (
        ("bad.npz", reach_with),
        ("bad.json", lambda path: replay_with(learned, path)),
    ):
        (tmp_path / name).write_bytes(data)
        assert told_in_one_line(lambda path=tmp_path / name, use=use: use(path), capsys)
