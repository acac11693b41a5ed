"""The page that adds an arm, typed as it stands there."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from emulated import served
from made_up_films import film

from imitation.robots.emulated_servos import MAKES
from imitation.robots.servo_bus_emulator import ServoBusEmulator

PAGE = Path(__file__).parents[2] / "docs" / "own_arm.md"
BLOCK = re.compile(r"^`(?P<name>[\w./]+)`:.*?^```\w+\n(?P<text>.*?)^```", re.MULTILINE | re.DOTALL)


@pytest.fixture
def installed(tmp_path) -> Path:
    """A folder of packages that holds the arm of the page as pip would leave it."""
    files = {match["name"]: match["text"] for match in BLOCK.finditer(PAGE.read_text())}
    assert sum(len(text.splitlines()) for text in files.values()) < 100
    for name, text in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    for package in ("my_arm", "my_arm/conf"):
        (tmp_path / package / "__init__.py").touch()
    told = tmp_path / "my_arm-0.1.dist-info"
    told.mkdir()
    (told / "METADATA").write_text("Metadata-Version: 2.1\nName: my-arm\nVersion: 0.1\n")
    entry = re.search(r'^my_arm = "(.*)"$', files["pyproject.toml"], re.MULTILINE)
    (told / "entry_points.txt").write_text(f"[imitation.robots]\nmy_arm = {entry[1]}\n")
    return tmp_path


def imitate(folder: Path, *words: str) -> subprocess.CompletedProcess:
    code = f"import sys; sys.path.insert(0, {str(folder)!r}); from cli.main import main; main()"
    call = [sys.executable, "-c", code, *words]
    return subprocess.run(call, cwd=folder, capture_output=True, text=True, timeout=100)


@pytest.mark.slow
def test_the_arm_of_the_page_learns_a_map(installed):
    run = imitate(installed, "learn-map", "robot=my_arm", "out=run")
    assert run.returncode == 0, run.stderr
    assert json.loads((installed / "run" / "metrics.json").read_text())["areas_learned"] == 16


@pytest.mark.slow
def test_doctor_looks_at_it_too(installed):
    run = imitate(installed, "doctor", "robot=my_arm", "--json")
    assert run.returncode == 0, run.stdout
    assert any("my_arm" in one["told"] for one in json.loads(run.stdout))


@pytest.mark.slow
def test_the_bus_servos_of_the_page_move(installed):
    servos = ServoBusEmulator(make=MAKES["xl430"])
    film(installed / "film.mp4", frames=150)
    bus = ("robot=my_servos", "robot.arm.address=bus", "camera.device=film.mp4")
    words = ("--config-dir", "mine", *bus, "learning.limit=1", "out=run", "--yes")
    with served(servos, installed / "bus"):
        run = imitate(installed, "learn-map", *words)
    assert run.returncode == 1, run.stderr  # in that film no hand obeys the arm
    assert servos.posture()[4] == pytest.approx(1.571, abs=0.2)  # as in the guided postures


def test_an_arm_that_is_not_installed_is_refused_with_those_that_are(installed):
    run = imitate(installed, "learn-map", "robot=my_army")
    assert run.returncode == 2
    assert "robot" in run.stderr


def test_an_installed_package_without_its_robots_stops_no_other_robot(installed):
    entry = installed / "my_arm-0.1.dist-info" / "entry_points.txt"
    entry.write_text("[imitation.robots]\nmy_arm = nowhere.conf\n")
    run = imitate(installed, "learn-map", "robot=ideal", "learning.limit=0.2", "out=run")
    assert run.returncode == 1  # too short to learn anything
    assert "nowhere.conf, which is not there" in run.stderr
    assert "Traceback" not in run.stderr
