"""Swap by address: a rig of "real" devices whose addresses are those of a cell that is up."""

import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from hil.recording.read import load
from hil.recording.summary import summarise


@pytest.fixture
def cell(begin, hil, tmp_path):
    """An emulated cell that is up, in lockstep so that a busy machine cannot make it late."""
    shown = json.loads(hil("rig", "show", "ffc_ur5", "--json").stdout)
    shown["robot"]["ports"] = dict.fromkeys(shown["robot"]["ports"], 0)
    shown["sensor"]["tcp"] = {"enabled": True, "port": 0}
    (tmp_path / "cell.yaml").write_text(json.dumps(shown))
    child = begin("up", "cell.yaml", "--clock", "lockstep", "--json")
    text = ""
    while not text.endswith("}\n"):
        line = child.stdout.readline()
        assert line, child.stderr.read()
        text += line
    yield shown, json.loads(text)
    child.send_signal(signal.SIGINT)
    assert child.wait(60) == 0


@pytest.fixture
def real(cell, tmp_path):
    """Writes the rig file that names the cell's addresses as real ones."""
    shown, doors = cell

    def write(wire):
        host, port = doors["sensor_tcp"].split(":")
        names = ("dashboard", "primary", "secondary", "realtime", "rtde")
        robot = shown["robot"] | {"host": doors["host"], "ports": {n: doors[n] for n in names}}
        sensor = shown["sensor"] | {"wire": wire, "tcp": {"host": host, "port": int(port)}}
        bus = {"interface": doors["can_interface"], "channel": doors["can_channel"]}
        rig = shown | {"rig": "real", "clock": "wall", "robot": robot, "sensor": sensor, "can": bus}
        (tmp_path / "real.yaml").write_text(json.dumps(rig))
        return "real.yaml"

    return write


@pytest.mark.parametrize("wire", ["can", "tcp"])
def test_the_same_near_side_assembles_at_the_addresses_of_a_real_rig(hil, real, tmp_path, wire):
    ended = hil("run", real(wire), "--out", "run")
    assert (ended.returncode, ended.stderr) == (0, "")
    assert "the real arm" in ended.stdout
    assert summarise(load(tmp_path / "run")).outcome.startswith("inserted")


def test_a_dry_run_names_the_devices_and_opens_nothing(hil, real, tmp_path):
    ended = hil("run", real("tcp"), "--dry-run", "--json")
    intent = json.loads(ended.stdout)
    assert intent["rig"] == "ffc_ur5 (real)"
    assert intent["sensor"].startswith("TCP 127.0.0.1:")
    assert not (tmp_path / "out").exists()


def test_the_contract_suites_hold_at_the_addresses_of_a_real_rig(real, tmp_path):
    suites = Path(__file__).parents[1] / "contract"
    command = ["-m", "pytest", str(suites), "-q", "-m", "real_ok", "--moves", "--rig"]
    ended = subprocess.run(
        [sys.executable, *command, str(tmp_path / real("tcp"))],
        cwd=suites.parents[1], capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert ended.returncode == 0, ended.stdout
    assert " passed" in ended.stdout
