"""`hil doctor RIG` on a cell that is up, and on one that is not."""

import json
import signal
import socket

import pytest

PORTS = ("dashboard", "primary", "secondary", "realtime", "rtde")


@pytest.fixture
def rig(tmp_path):
    """A rig file with ports that were free a moment ago, its sensor on TCP."""
    probes = [socket.create_server(("127.0.0.1", 0)) for _ in (*PORTS, "sensor")]
    *robot, sensor = [probe.getsockname()[1] for probe in probes]
    for probe in probes:
        probe.close()
    content = {
        "name": "patient",
        "robot": {"ports": dict(zip(PORTS, robot, strict=True))},
        "sensor": {"wire": "tcp", "tcp": {"port": sensor}},
        "physics": {"plant": "wall"},
    }
    (tmp_path / "rig.yaml").write_text(json.dumps(content))
    return "rig.yaml"


def examined(hil, rig):
    """Exit status and findings by name."""
    ended = hil("doctor", rig, "--json")
    assert ended.stderr == ""
    return ended.returncode, {entry["name"]: entry for entry in json.loads(ended.stdout)}


def test_a_cell_that_is_up_is_reached_and_known(begin, hil, rig):
    child = begin("up", rig, "--json")
    while "}" not in child.stdout.readline():
        pass
    status, found = examined(hil, rig)
    assert status == any(entry["verdict"] == "fail" for entry in found.values())
    for name in (*PORTS, "robot mode", "safety mode", "controller"):
        assert found[name]["verdict"] == "ok", found[name]
    # How well they keep time is this machine's affair.
    assert {"rtde rate", "host jitter", "real-time priority"} <= set(found)
    child.send_signal(signal.SIGINT)
    assert child.wait(60) == 0


def test_a_cell_that_is_not_up_fails_with_the_way_out(hil, rig):
    status, found = examined(hil, rig)
    assert status == 1
    assert found["rtde"]["verdict"] == "fail"
    assert "hil up" in found["rtde"]["advice"]
    assert "refused" in found["sensor"]["found"]
