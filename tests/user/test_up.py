"""`hil up` for clients of one's own."""

import json
import signal
import socket

import pytest

from drivers.ur.arm import UrArm, UrPorts

DOORS = ("dashboard", "primary", "secondary", "realtime", "rtde")


def free_ports():
    """Five ports that were free a moment ago."""
    probes = [socket.create_server(("127.0.0.1", 0)) for _ in DOORS]
    found = [probe.getsockname()[1] for probe in probes]
    for probe in probes:
        probe.close()
    return dict(zip(DOORS, found, strict=True))


@pytest.fixture
def rig(hil, tmp_path):
    """A rig file with fixed ports that nobody else uses."""
    shown = json.loads(hil("rig", "show", "ffc_ur5", "--json").stdout)
    shown["robot"]["ports"] = free_ports()
    (tmp_path / "rig.yaml").write_text(json.dumps(shown))  # JSON is YAML
    return "rig.yaml"


def served(child):
    """The address line that `hil up --json` prints once its doors are open."""
    text = ""
    while not text.endswith("}\n"):
        line = child.stdout.readline()
        assert line, child.stderr.read()
        text += line
    return json.loads(text)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_driver_is_served_and_the_ports_are_free_afterwards(begin, rig, number):
    child = begin("up", rig, "--json")
    doors = served(child)
    arm = UrArm(doors["host"], UrPorts(doors["rtde"], doors["dashboard"], doors["secondary"]))
    with arm:
        arm.servo(arm.read().pose)
        assert arm.read().t > 0
    child.send_signal(number)
    _, said = child.communicate(timeout=60)
    assert (child.returncode, said) == (0, "")
    for door in DOORS:
        socket.create_server((doors["host"], doors[door])).close()


def test_an_arm_is_powered_by_its_client_or_from_the_start(begin, rig):
    for option, mode in (((), "POWER_OFF"), (("--powered",), "RUNNING")):
        child = begin("up", rig, "--json", *option)
        doors = served(child)
        with socket.create_connection((doors["host"], doors["dashboard"])) as dashboard:
            lines = dashboard.makefile("rb")
            assert lines.readline().startswith(b"Connected")
            said = ""
            while mode not in said:
                dashboard.sendall(b"robotmode\n")
                said = lines.readline().decode()
        child.send_signal(signal.SIGINT)
        child.communicate(timeout=60)


def test_a_second_cell_on_the_same_ports_is_one_line_with_the_way_out(begin, hil, rig):
    first = begin("up", rig, "--json")
    served(first)
    second = hil("up", rig)
    assert (second.returncode, second.stdout) == (1, "")
    assert second.stderr.startswith("hil: dashboard port 127.0.0.1:")
    assert "set robot.ports.dashboard to 0" in second.stderr
    first.send_signal(signal.SIGINT)
    first.communicate(timeout=60)
    assert first.returncode == 0
