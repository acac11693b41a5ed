"""Where nothing can be written, a command says so in one line and leaves nothing half."""

import shutil

import pytest
from small_disk import make_read_only, small_disk


@pytest.fixture(scope="module")
def run(reached_shortly, tmp_path_factory):
    """The same without what is derived: not to be changed."""
    folder = tmp_path_factory.mktemp("places") / "run"
    shutil.copytree(reached_shortly, folder, ignore=shutil.ignore_patterns("run.rrd"))
    return folder


def cut(run, folder):
    """The same run, killed."""
    folder.mkdir()
    data = (run / "run.mcap").read_bytes()
    (folder / "run.mcap").write_bytes(data[: len(data) * 7 // 10])


WRITING = {
    "export to csv": ("export", "{disk}/run", "--to", "csv", "{disk}/a.csv"),
    "export to parquet": ("export", "{disk}/run", "--to", "parquet", "{disk}/a.parquet"),
    "export to video": ("export", "{disk}/run", "--to", "video", "{disk}/a.mp4"),
    "export to lerobot": ("export", "{disk}/run", "--to", "lerobot", "{disk}/a"),
    "view": ("view", "{disk}/run", "--screenshot", "{disk}/a.png"),
    "what if": ("verify", "{disk}/run", "--with", "dynamics.tau=0.3"),
    "recover": ("recover", "{disk}/cut"),
}


def one_line(result, told):
    assert told in result.stderr, result.output
    assert result.stderr.count("\n") == 1 and "Traceback" not in result.output


@pytest.mark.parametrize("name", WRITING)
def test_a_disk_that_cannot_be_written_is_one_line(imitate, run, name):
    with small_disk(imitate.folder / "disk", "2m") as disk:
        shutil.copytree(run, disk / "run")
        cut(run, disk / "cut")
        make_read_only(disk)
        result = imitate(*(word.format(disk=disk) for word in WRITING[name]))
        assert result.exit_code == 2
        one_line(result, "is read-only for you; ")


def test_a_run_that_cannot_be_written_is_read_all_the_same(imitate, run):
    with small_disk(imitate.folder / "disk", "2m") as disk:
        shutil.copytree(run, disk / "run")
        make_read_only(disk)
        for words in (("inspect",), ("verify",), ("explain", "--at", "0.5"), ("recover",)):
            result = imitate(words[0], str(disk / "run"), *words[1:])
            assert result.exit_code == 0, result.output
        result = imitate("reach", f"map={run}", f"out={disk / 'new'}")
        assert result.exit_code == 2
        one_line(result, "cannot be made: Read-only file system")


@pytest.mark.parametrize("name", WRITING)
def test_a_full_disk_is_one_line_and_leaves_nothing_half(imitate, run, name):
    with small_disk(imitate.folder / "disk", "2m") as disk:
        shutil.copytree(run, disk / "run")
        cut(run, disk / "cut")
        (disk / "full").write_bytes(b"0" * (shutil.disk_usage(disk).free - 4096))
        before = {path: path.stat().st_size for path in disk.rglob("*")}
        result = imitate(*(word.format(disk=disk) for word in WRITING[name]))
        assert result.exit_code == 3, result.output
        one_line(result, "cannot be written: ")
        assert {path: path.stat().st_size for path in disk.rglob("*")} == before
