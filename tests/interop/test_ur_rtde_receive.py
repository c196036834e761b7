"""ur_rtde 1.6, a client this project did not write, reads and writes the emulated control box."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from hil.cell.rig.robot import Ports

CLIENT = Path(__file__).with_name("ur_rtde_client.py")


@pytest.fixture
def host():
    """A loopback address of this process alone, since ur_rtde always calls port 30004."""
    if sys.platform != "linux":
        pytest.skip("only Linux answers on all of 127/8")
    pid = os.getpid()
    return f"127.{1 + (pid >> 16) % 250}.{(pid >> 8) & 255}.{1 + (pid & 255) % 254}"


@pytest.fixture
def served(robot, emulated_arm, host):
    arm = emulated_arm(host, ports=Ports(dashboard=0, primary=0, secondary=0, realtime=0))
    with arm.running(arm.wall):
        yield arm


@pytest.fixture
def seen(served, host):
    """What the client printed."""
    command = [sys.executable, str(CLIENT), host]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout[done.stdout.index("{") :])


def test_ur_rtde_reads_state_and_sets_an_output(seen, served, robot):
    step = served.period * 1e-9
    cycles = [t / step for t in seen["times"]]
    assert len(cycles) == 20
    assert cycles == pytest.approx([round(cycle) for cycle in cycles], abs=1e-6)
    assert cycles == sorted(cycles)
    assert seen["q"] == pytest.approx(robot.home)
    assert seen["pose"] == pytest.approx(served.controller.port.actual_tcp_pose())
    assert (seen["robot_mode"], seen["safety_mode"]) == (3, 1)
    assert (seen["before"], seen["accepted"], seen["after"]) == (False, True, True)
