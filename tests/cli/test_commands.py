"""Every command has help and a place in the README, and starts quickly."""

import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest
from omegaconf import OmegaConf
from typer.main import get_command

import imitation
from cli.check import checked
from cli.command_group import GROUPS
from cli.errors import UserError
from cli.help import EXAMPLES, complete
from cli.keys import CONF, comments, groups, groups_of
from cli.main import app
from cli.schema import COMMANDS

ROOT = Path(__file__).parents[2]
NAMES = sorted(get_command(app).commands)
HEAVY = {"pybullet", "cv2", "rerun", "matplotlib", "hydra", "numpy", "omegaconf"}


@pytest.mark.parametrize("name", NAMES)
def test_a_command_is_documented_in_the_readme(name):
    assert f"imitate {name}" in (ROOT / "README.md").read_text()


@pytest.mark.parametrize("name", NAMES)
def test_a_command_has_help(imitate, name):
    result = imitate(name, "--help")
    assert result.exit_code == 0
    assert get_command(app).commands[name].help in " ".join(result.stdout.split())


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_help_teaches(imitate, name):
    told = imitate(name, "--help").stdout
    for typed, _ in EXAMPLES[name]:
        assert typed in told
    for heading in ("Keys:", "Groups:", "Sweeps:", "Exit codes:"):
        assert heading in told


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_examples_quote_brackets(name):
    for typed, _ in EXAMPLES[name]:
        for word in typed.split():
            assert "[" not in word or word.startswith("'")


def test_without_a_command_the_help_is_shown(imitate):
    result = imitate()
    assert result.exit_code == 0
    for name in NAMES:
        assert name in result.stdout


def test_the_version_is_told(imitate):
    assert imitate("--version").stdout.startswith("imitate 0.")


def test_help_imports_nothing_heavy():
    code = (
        "import sys; from typer.testing import CliRunner; from cli.main import app; "
        "CliRunner().invoke(app, ['learn-map', '--help']); print(*sys.modules)"
    )
    call = [sys.executable, "-c", code]
    told = subprocess.run(call, capture_output=True, text=True, timeout=60, check=True)
    assert not HEAVY & set(told.stdout.split())


def test_nothing_but_the_result_is_printed_on_stdout(tmp_path):
    code = "import imitation.robots.bullet.world"
    call = [sys.executable, "-c", code]
    told = subprocess.run(call, capture_output=True, text=True, timeout=60, check=True)
    assert told.stdout == told.stderr == ""


def test_the_package_named_imitation_is_ours():
    assert Path(imitation.__file__).is_relative_to(ROOT)


def test_cfg_shows_the_configuration_and_runs_nothing(imitate, capsys):
    result = imitate("learn-map", "--cfg", "job", "robot=ideal", "seed=7")
    assert result.exit_code == 0
    assert OmegaConf.create(result.stdout).seed == 7
    assert not list(imitate.folder.iterdir())


@pytest.mark.parametrize(
    ("command", "typed", "offered"),
    [
        ("learn-map", "rob", "robot=ideal"),
        ("learn-map", "robot=i", "robot=ideal"),
        ("learn-map", "learning.l", "learning.limit="),
        ("reach", "contr", "controller=yuragi"),
        ("reach", "tri", "trials="),
    ],
)
def test_a_shell_is_offered_keys_and_choices(command, typed, offered):
    class Context:
        info_name, params = command, {}

    words = [word for word, _ in complete(Context(), typed)]
    assert offered in words
    assert all(word.startswith(typed) for word in words)


@pytest.mark.parametrize("name", groups()["experiment"])
def test_an_experiment_is_offered_for_the_commands_that_it_composes_for(name):
    from hydra import compose, initialize_config_module
    from hydra.errors import ConfigCompositionException

    composed = []
    with initialize_config_module("conf", version_base="1.3"):
        given = ["map=somewhere"]
        both = [*given, "action=somewhere"]
        commands = {"learn-map": [], "reach": given, "mimic": given, "replay": both}
        for command, more in commands.items():
            # One about controllers or imitation does not fit learn-map.
            with suppress(ConfigCompositionException, UserError):
                cfg = compose(command.replace("-", "_"), [f"experiment={name}", *more])
                checked(command, cfg)
                composed.append(command)
    assert composed
    assert composed == [one for one in commands if name in groups_of(one)["experiment"]]


def choices_of_commands():
    """All of them; of those that several commands take, all but the first are slow."""
    known = set()
    for command in sorted(set(COMMANDS) - {"figure"}):
        for group, choices in groups_of(command).items():
            for choice in choices if group != "experiment" else ():  # not each fits each command
                marks = [pytest.mark.slow] if (group, choice) in known else []
                known.add((group, choice))
                yield pytest.param(command, group, choice, marks=marks)


@pytest.mark.parametrize(("command", "group", "choice"), list(choices_of_commands()))
def test_every_choice_composes_and_passes_the_check(command, group, choice):
    from hydra import compose, initialize_config_module

    with initialize_config_module("conf", version_base="1.3"):
        composed = compose(command.replace("-", "_"), [f"{group}={choice}"])
    for key in OmegaConf.missing_keys(composed):
        OmegaConf.update(composed, key, "given")
    checked(command, composed)


@pytest.mark.parametrize("path", sorted(CONF.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_number_of_a_command_says_what_it_is(path):
    if path.stem == "common":
        return
    numbers = OmegaConf.load(path)
    for key, told in comments(path.stem).items():
        value = OmegaConf.select(numbers, key, throw_on_resolution_failure=False)
        if isinstance(value, int | float):
            assert told, f"{key} has no comment"


def test_the_help_names_every_command_in_one_group(imitate):
    named = [name for names in GROUPS.values() for name in names]
    assert sorted(named) == sorted(get_command(app).commands)
    out = imitate("--help").stdout
    assert all(f"{title}:" in out for title in GROUPS)
    assert all(f"  {name} " in out for name in named)
