"""The ports at which emulated devices are found, and what is left of them."""

from contextlib import closing

import pytest
from emulated import served

from imitation.robots.serving import Server
from imitation.robots.ssc32_emulator import Ssc32Emulator

FREE = "exists already; give --pty a path that is free"


@pytest.fixture
def server():
    with closing(Server(Ssc32Emulator())) as server:
        yield server


def test_a_port_never_served_goes_with_its_server(server, tmp_path):
    server.open_pty(tmp_path / "port")
    server.close()
    server.close()
    assert not list(tmp_path.iterdir())


def test_the_link_of_a_killed_emulator_is_replaced(server, tmp_path):
    link = tmp_path / "port"
    link.symlink_to("/dev/pts/999999")
    server.open_pty(link)
    assert link.exists()


@pytest.mark.parametrize("target", ["thing", ".", "/dev/null", "/nowhere", "gone"])
def test_what_is_no_link_of_an_emulator_is_kept(server, tmp_path, target):
    (tmp_path / "thing").touch()
    link = tmp_path / "port"
    link.symlink_to(target)
    with pytest.raises(ValueError, match=FREE):
        server.open_pty(link)
    server.close()
    assert str(link.readlink()) == target


def test_the_port_of_a_running_emulator_is_not_taken(server, tmp_path):
    link = tmp_path / "port"
    with served(Ssc32Emulator(), link):
        before = link.readlink()
        with pytest.raises(ValueError, match=FREE):
            server.open_pty(link)
        assert link.readlink() == before


def test_a_link_that_took_the_place_of_ones_own_is_kept(server, tmp_path):
    link = tmp_path / "port"
    server.open_pty(link)
    link.unlink()
    link.symlink_to("/dev/pts/999999")
    server.close()
    assert link.is_symlink()
