"""Who may import whom: cli -> stages, recording, analysis -> core, seams -> numpy; never back."""

import ast
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
MODULES = sorted(path for name in ("cli", "imitation") for path in (ROOT / name).rglob("*.py"))

# The only place where a package may be imported, as a beginning of the module's name.
AT_HOME = {
    "typer": "cli.",
    "hydra": "cli.",
    "omegaconf": "cli.",
    "pydantic": "cli.",
    "yaml": ("cli.", "imitation.recording.yaml_reading"),
    "rich": "cli.",
    "pybullet": "imitation.robots.bullet.world",
    "pybullet_data": "imitation.robots.bullet.world",
    "mcap": "imitation.recording.mcap_",
    "rosbags": "imitation.recording.messages",
    "rerun": "imitation.recording.rerun_view",
    "matplotlib": "imitation.analysis.",
    "serial": "imitation.robots.serial_line",
    "rustypot": "imitation.robots.servo_bus",
}
# What each layer of our own may import; a layer may always import itself.
CORE = {"core"}
LAYERS = {
    "core": set(),
    "controllers": CORE,
    "robots": CORE,
    "stages": CORE | {"controllers"},
    "recording": CORE,
    "analysis": CORE | {"controllers", "recording", "stages"},
    "cli": CORE | {"controllers", "robots", "stages", "recording", "analysis"},
}
CORE_MAY_IMPORT = {"numpy", "cv2"}


def name_of(path):
    return ".".join(path.relative_to(ROOT).with_suffix("").parts)


def imported(path):
    """Every module that a file imports, at its head or inside a function."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: write imports in full"
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def layer_of(module):
    first, _, rest = module.partition(".")
    if first in ("cli", "conf"):
        return "cli"
    package = rest.split(".")[0]
    return package if package in LAYERS else "core"


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_a_package_is_imported_only_at_its_home(path):
    for module in imported(path):
        home = AT_HOME.get(module.split(".")[0])
        assert home is None or name_of(path).startswith(home), f"{module} belongs in {home}"


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_imports_point_one_way(path):
    own = layer_of(name_of(path))
    for module in imported(path):
        if module.split(".")[0] in ("cli", "imitation"):
            other = layer_of(module)
            assert other == own or other in LAYERS[own], f"{own} must not import {module}"


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_the_core_is_numpy_only(path):
    if layer_of(name_of(path)) not in ("core", "controllers", "stages"):
        return
    allowed = CORE_MAY_IMPORT | {"imitation"} | set(sys.stdlib_module_names)
    assert {module.split(".")[0] for module in imported(path)} <= allowed


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_only_recorder_and_metrics_see_the_truth(path):
    if layer_of(name_of(path)) not in ("stages", "controllers"):
        return
    tree = ast.parse(path.read_text())
    names = {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    assert "truth" not in names
    assert not any("Truth" in module for module in imported(path))


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_a_stage_never_sleeps_or_reads_a_clock(path):
    if layer_of(name_of(path)) in ("stages", "controllers"):
        assert not {"time", "datetime"} & set(imported(path))
