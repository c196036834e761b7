"""can-utils on the kernel's bus, as a third party that listens, plays back and bends frames."""

import re
import subprocess
from itertools import pairwise

import can
import pytest

from drivers.errors import StaleSampleError
from drivers.nrs.bus import open_bus
from drivers.nrs.can_sensor import CanSensor

pytestmark = pytest.mark.socketcan

FRAMES = 400
REPLY = 0x481


def test_candump_and_cantools_decode_the_live_bus(vcan, tool, cantools, dbc):
    vcan.stream()
    candump = subprocess.Popen(
        [tool("candump"), "-r", "4000000", "-n", str(FRAMES), "vcan0"], stdout=subprocess.PIPE
    )
    with candump, candump.stdout as dumped:
        decode = subprocess.Popen(
            [*cantools, "decode", "--single-line", dbc],
            stdin=dumped,
            stdout=subprocess.PIPE,
            text=True,
        )
        while candump.poll() is None:
            vcan.step()
        with decode:
            lines, _ = decode.communicate(timeout=120)
    assert candump.returncode == decode.returncode == 0
    assert lines.count("NRS1_") == FRAMES
    counters = [int(found) for found in re.findall(r"F_Counter: (\d+)", lines)]
    assert len(counters) > FRAMES // 3
    assert all((after - before) % 256 == 1 for before, after in pairwise(counters))


def test_tshark_reads_what_candump_wrote(vcan, tool, tmp_path):
    vcan.stream()
    already = len(vcan.sent)
    command = [tool("candump"), "-L", "-r", "4000000", "-n", str(FRAMES), "vcan0"]
    with (tmp_path / "bus.log").open("wb") as log, subprocess.Popen(command, stdout=log) as candump:
        while candump.poll() is None:
            vcan.step()
    fields = ["-T", "fields", "-e", "can.id", "-e", "can.len"]
    tshark = subprocess.run(
        [tool("tshark"), "-r", tmp_path / "bus.log", *fields],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    seen = [tuple(map(int, line.split())) for line in tshark.stdout.splitlines()]
    assert len(seen) == FRAMES
    sent = [(frame.id, len(frame.data)) for frame in vcan.sent[already:]]
    assert any(sent[at : at + FRAMES] == seen for at in range(len(sent) - FRAMES + 1))


def test_canplayer_gives_the_driver_the_same_wrenches_again(can_cell, tool, tmp_path):
    messages, given = recorded(can_cell)
    answered = next(at for at, one in enumerate(messages) if one.arbitration_id == REPLY)
    driver = CanSensor("socketcan", "vcan0")
    driver.connect()
    try:
        driver.start()
        # The reply must not come before the question.
        play(tool("canplayer"), tmp_path / "boot.log", messages[:answered])
        driver.poll(0)
        play(tool("canplayer"), tmp_path / "rest.log", messages[answered:])
        reading = driver.read(8_000_000)
    finally:
        driver.close()
    assert list(reading.samples)[-len(given) :] == given
    assert driver.health.gaps == 0


def recorded(can_cell):
    """Everything that the node said since its boot, and what a first driver made of it."""
    with can_cell("virtual") as cell, open_bus(cell.gateway.address, fd=False) as bystander:
        cell.stream()
        given = []
        for _ in range(40):
            cell.load = cell.load * 0.97
            given += cell.read().samples
        messages = []
        while (message := bystander.recv(0)) is not None:
            if message.arbitration_id != 0x201:  # the driver's own
                messages.append(message)
    return messages, given


def play(canplayer, path, messages):
    with can.CanutilsLogWriter(path, channel="vcan0") as log:
        for message in messages:
            log(message)
    subprocess.run([canplayer, "-t", "-I", path, "vcan0=vcan0"], check=True, timeout=120)


@pytest.fixture
def routed(can_cell, tool):
    """(cell whose node is on vcan0 and whose driver is on vcan8, cangw, rule towards the driver)"""
    cangw = tool("cangw")

    def ip(*words):
        subprocess.run(["ip", "link", *words], check=True, timeout=30)

    there = ["-s", "vcan0", "-d", "vcan8", "-e"]
    ip("add", "dev", "vcan8", "type", "vcan")
    ip("set", "vcan8", "up")
    try:
        subprocess.run([cangw, "-A", *there], check=True, timeout=30)
        subprocess.run([cangw, "-A", "-s", "vcan8", "-d", "vcan0", "-e"], check=True, timeout=30)
        with can_cell("socketcan", "vcan0") as cell:
            cell.driver.close()
            cell.driver = CanSensor("socketcan", "vcan8")
            cell.driver.connect()
            yield cell, cangw, there
            cell.driver.close()
    finally:
        subprocess.run([cangw, "-F"], check=False, timeout=30)
        ip("del", "vcan8")


def test_a_counter_that_the_kernels_gateway_freezes_makes_samples_stale(routed):
    cell, cangw, there = routed
    cell.stream()
    assert cell.read().samples
    subprocess.run([cangw, "-D", *there], check=True, timeout=30)
    for identifier in ("181", "281"):
        bend = ["-f", f"{identifier}:7FF", "-m", "AND:D:0.0.FFFFFFFFFFFFFF00"]
        subprocess.run([cangw, "-A", *there, *bend], check=True, timeout=30)
    for _ in range(3):
        cell.step()
        cell.driver.poll(cell.t)
    with pytest.raises(StaleSampleError):
        cell.driver.read(cell.t)
