"""The lesson in the documents runs as it is printed."""

import re
import shlex
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[2] / "docs" / "lesson.md").read_text()
LINES = [
    line
    for block in re.findall(r"```\n(.*?)```", PAGE, re.DOTALL)
    for line in block.splitlines()
    if "imitate view" not in line  # that opens a window
]


@pytest.mark.slow
@pytest.mark.timeout(900)
def test_every_command_of_the_lesson_ends_well(imitate):
    for line in LINES:
        result = imitate(*shlex.split(line)[1:])
        assert result.exit_code == (1 if "--with" in line else 0), f"{line}\n{result.output}"
