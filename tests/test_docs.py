"""What the documents say is so."""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from imitation.recording.mcap_recording import Recording

DOCS = Path(__file__).parents[1] / "docs"
sys.path.insert(0, str(Path(__file__).parent / "recording"))


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A made-up run and its table."""
    import made_up

    from cli.export import export

    folder = tmp_path_factory.mktemp("read") / "run"
    folder.mkdir()
    with made_up.recorder(folder / "run.mcap") as recorder:
        for sample, truths in made_up.run(30):
            recorder.write(sample, truths)
    assert export([folder, folder / "steps.parquet"], "parquet") == 0
    return folder


def blocks(name):
    return re.findall(r"```python\n(.*?)```", (DOCS / name).read_text(), re.DOTALL)


@pytest.mark.parametrize("code", blocks("reading.md"), ids=["rosbags", "ours", "table"])
def test_a_run_is_read_as_the_page_says(run, code):
    assert len([line for line in code.splitlines() if line.strip()]) <= 11
    names = {"run": run, "steps": run / "steps.parquet"}
    exec(code, names)
    read = names.get("times") or names.get("told") or names.get("seen")
    assert len(read) in (3, 30)


def test_every_topic_is_on_the_page(run):
    page = (DOCS / "recording.md").read_text()
    for topic, kind in Recording.open(run).topics.items():
        assert f"`{topic}`" in page
        assert kind.type.rpartition("/")[2] in page


def test_every_kind_of_event_is_on_the_page():
    page = (DOCS / "recording.md").read_text()
    table = page.partition("### Kinds of events")[2].partition("\n\nThe names")[0]
    listed = {kind for row in re.findall(r"^\| (`.*?) \|", table, re.MULTILINE)
              for kind in re.findall(r"`(\w+)`", row)}  # fmt: skip
    assert listed == set(told_kinds())


def told_kinds() -> Iterator[str]:
    """The kinds that the code tells: the first argument of every Event or `_told`."""
    root = DOCS.parent
    for path in [*(root / "imitation").rglob("*.py"), *(root / "cli").rglob("*.py")]:
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("Event", "_told"):
                first = node.args[0] if node.args else None
                if isinstance(first, ast.Constant) and isinstance(first.value, str):
                    yield first.value
