"""What a running `hil up` says of itself: asked by a signal, by another command, and at its end."""

import json
import signal
import socket

import pytest

DOORS = ("dashboard", "primary", "secondary", "realtime", "rtde")


@pytest.fixture
def rig(hil, tmp_path):
    shown = json.loads(hil("rig", "show", "plate_ur5", "--json").stdout)
    shown["name"] = "asked"
    shown["robot"]["ports"] = dict.fromkeys(DOORS, 0)
    (tmp_path / "rig.yaml").write_text(json.dumps(shown))  # JSON is YAML
    return "rig.yaml"


@pytest.fixture
def running(begin, rig):
    """A cell that serves, and what it said of its doors."""
    child = begin("up", rig, "--json")
    text = ""
    while not text.endswith("}\n"):
        line = child.stdout.readline()
        assert line, child.stderr.read()
        text += line
    return child, json.loads(text)


def test_another_command_shows_the_clients_and_how_time_is_kept(hil, running, rig):
    child, doors = running
    with socket.create_connection((doors["host"], doors["dashboard"])) as client:
        client.recv(100)
        answer = hil("up", rig, "--status", "--json")
        (status,) = map(json.loads, answer.stdout.splitlines())
        table = hil("up", rig, "--status").stdout
    assert status["rtde"] == doors["rtde"]
    assert status["traffic"]["clients"]["dashboard"] == 1
    assert status["lateness"]["periods"] <= status["traffic"]["periods"] + 1
    assert "periods missed" in table
    child.send_signal(signal.SIGINT)
    child.communicate(timeout=60)
    gone = hil("up", rig, "--status")
    assert (gone.returncode, gone.stdout) == (1, "")
    assert "no `hil up rig.yaml` is running" in gone.stderr


def test_a_signal_and_the_end_bring_a_line_each(running):
    child, _ = running
    child.send_signal(signal.SIGUSR1)
    told = json.loads(child.stdout.readline())
    child.send_signal(signal.SIGTERM)
    rest, said = child.communicate(timeout=60)
    (end,) = map(json.loads, rest.splitlines())
    assert (child.returncode, said) == (0, "")
    assert end["traffic"]["periods"] >= told["traffic"]["periods"]
