"""Emulated devices as people start them."""

import re
import signal
import socket
import subprocess
import sys

import pytest

from imitation.robots.serial_line import SerialLine


def started(*words: str) -> subprocess.Popen:
    call = [sys.executable, "-c", "from cli.main import main; main()", "emulate", *words]
    return subprocess.Popen(call, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def ended(process: subprocess.Popen) -> int:
    process.send_signal(signal.SIGTERM)
    return process.wait(timeout=20)


def test_a_katana_answers_on_tcp_until_it_is_ended():
    process = started("katana", "--model", "450", "--port", "0")
    where = process.stdout.readline().split()[2].rstrip(";")
    host, port = where.split(":")
    with socket.create_connection((host, int(port)), 5) as client:
        client.sendall(bytes.fromhex("011801423180"))
        assert client.recv(100)[:2] == b"b\x02"
    assert ended(process) == 130


def test_an_ssc32_answers_on_a_serial_port_that_goes_with_it(tmp_path):
    process = started("ssc32", "--pty", str(tmp_path / "neck"), "--speed", "10")
    assert str(tmp_path / "neck") in process.stdout.readline()
    line = SerialLine(str(tmp_path / "neck"), 115200, 1.0)
    line.send(b"ver\r")
    assert line.receive(15, 2.0) == b"SSC32-V2.50USB\r"
    line.close()
    ended(process)
    assert not list(tmp_path.iterdir())


def test_the_servos_of_a_bus_answer_on_a_serial_port(tmp_path):
    process = started("servo-bus", "--pty", str(tmp_path / "bus"))
    assert str(tmp_path / "bus") in process.stdout.readline()
    line = SerialLine(str(tmp_path / "bus"), 1_000_000, 1.0)
    line.send(bytes.fromhex("ffff010201fb"))  # ping servo 1
    assert line.receive(6, 2.0) == bytes.fromhex("ffff010200fc")
    line.close()
    assert ended(process) == 130


def test_dynamixel_servos_answer_as_their_maker_wrote_it_down(tmp_path):
    process = started("servo-bus", "--model", "xm430", "--pty", str(tmp_path / "bus"))
    process.stdout.readline()
    line = SerialLine(str(tmp_path / "bus"), 57600, 1.0)
    line.send(bytes.fromhex("fffffd000103000119 4e"))  # ping servo 1
    assert line.receive(14, 2.0)[:11] == bytes.fromhex("fffffd0001070055 00 fc03")
    line.send(bytes.fromhex("fffffd0001070002840004001d15"))  # where is it
    assert line.receive(15, 2.0)[8:13] == bytes.fromhex("0000080000")
    line.close()
    assert ended(process) == 130


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["toaster", "--port", "0"], "no device toaster"),
        (["katana", "--model", "500", "--port", "0"], "no model 500"),
        (["servo-bus", "--model", "400", "--pty", "here"], "no model 400"),
        (["katana"], "either --port"),
        (["katana", "--port", "0", "--pty", "here"], "either --port"),
        (["katana", "--port", "0", "--fault", "fire"], "no fault fire"),
        (["katana", "--port", "0", "--fault", "crashed_motor=9"], "crashed_motor=1 to .*=6"),
        (["servo-bus", "--port", "0", "--fault", "hot_servo=7"], "hot_servo=1 to hot_servo=6"),
        (["ssc32", "--port", "0", "--fault", "silence=2"], "silence is of the whole device"),
        *(
            (["katana", "--port", "0", "--speed", speed], "above 0")
            for speed in ("0", "nan", "inf", "1e300")
        ),
        (["ssc32", "--pty", "no/where"], "no folder no"),
        (["ssc32", "--pty", "here", "--model", "300"], "one model; leave out --model"),
        (["katana", "--port", "99999"], "cannot be used"),
    ],
)
def test_what_cannot_be_emulated_is_told_in_one_line(imitate, words, told):
    result = imitate("emulate", *words)
    assert result.exit_code == 2
    assert re.search(told, result.stderr)
    assert result.stderr.count("\n") == 1


@pytest.fixture
def taken():
    """A TCP port that somebody uses."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        yield str(listener.getsockname()[1])


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--stream", "TAKEN"], "cannot be used"),
        (["--model", "500"], "no model 500"),
        (["robot=so101", "--model", "300"], "--model is of a Katana, not of robot=so101"),
        (["--stream", "0", "--port", "TAKEN"], "cannot be used"),
        (["robot=so101", "--stream", "TAKEN"], "cannot be used"),
        (["robot=so101", "--stream", "0", "--pty", "used"], "used exists already"),
        (["robot=so101", "--stream", "0", "--pty", "arm"], "arm and neck are both at arm"),
    ],
)
def test_a_twin_that_is_refused_leaves_nothing_behind(
    imitate, taken, tmp_path, monkeypatch, words, told
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "used").touch()
    result = imitate("twin", *(taken if word == "TAKEN" else word for word in words))
    assert result.exit_code == 2
    assert told in result.stderr
    assert result.stderr.count("\n") == 1
    assert [one.name for one in tmp_path.iterdir()] == ["used"]
