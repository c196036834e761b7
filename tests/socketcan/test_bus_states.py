"""A serial CAN adapter on a pseudo terminal: the kernel's own error-passive and bus-off."""

import contextlib
import fcntl
import os
import pty
import struct
import subprocess
import termios
import tty
from pathlib import Path

import pytest

from drivers.errors import BusFaultError
from drivers.interfaces import BusState, Freshness
from drivers.nrs.can_sensor import CanSensor
from drivers.protocol.frame import CanFrame

pytestmark = pytest.mark.socketcan

N_SLCAN = 17  # linux/tty.h
SIOCGIFNAME = 0x8910
POLLS = 200_000


class SerialAdapter:
    """What a Lawicel-style adapter says to the kernel: frames as `t`, states as `s`, errors as `e`.

    The kernel makes a network interface of it. Nothing is asked of the adapter when the interface
    goes up, as if `slcand -o` had opened it before.
    """

    def __init__(self):
        self._ours, self._kernels = pty.openpty()
        tty.setraw(self._ours)
        tty.setraw(self._kernels)
        os.set_blocking(self._ours, False)
        fcntl.ioctl(self._kernels, termios.TIOCSETD, struct.pack("i", N_SLCAN))
        name = fcntl.ioctl(self._kernels, SIOCGIFNAME, bytes(32))
        self.interface = name.split(b"\0")[0].decode()
        self._heard = b""
        self.on_bus = True
        self.link("txqueuelen", "1000", "up")

    def link(self, *words):
        subprocess.run(["ip", "link", "set", self.interface, *words], check=True, timeout=30)

    @property
    def link_state(self):
        shown = subprocess.run(
            ["ip", "-details", "link", "show", self.interface],
            check=True,
            timeout=30,
            capture_output=True,
            text=True,
        )
        return shown.stdout.split("can state ")[1].split()[0].lower()

    def send(self, frames):
        if self.on_bus:
            for frame in frames:
                self._write(f"t{frame.id:03X}{len(frame.data)}{frame.data.hex().upper()}")

    def state(self, letter, receive_errors, transmit_errors):
        """Report the controller's state and error counters."""
        self.on_bus = letter != "b"
        self._write(f"s{letter}{receive_errors:03d}{transmit_errors:03d}")

    def _write(self, text):
        line = text.encode() + b"\r"
        while line:
            try:
                line = line[os.write(self._ours, line) :]
            except BlockingIOError:  # the kernel's worker has yet to take what is there
                os.sched_yield()

    def receive(self):
        with contextlib.suppress(BlockingIOError):
            self._heard += os.read(self._ours, 1 << 16)
        *lines, self._heard = self._heard.split(b"\r")
        return [_frame(line.decode()) for line in lines if line.startswith(b"t")]

    def close(self):
        os.close(self._kernels)
        os.close(self._ours)


def _frame(line):
    return CanFrame(int(line[1:4], 16), bytes.fromhex(line[5:]))


@pytest.fixture
def adapter():
    if not Path("/sys/module/slcan").exists():
        pytest.skip("the kernel has no slcan: modprobe slcan, or run scripts/uml-run")
    adapter = SerialAdapter()
    yield adapter
    adapter.close()


@pytest.fixture
def cell(adapter, cell_of):
    driver = CanSensor("socketcan", adapter.interface)
    driver.connect()
    cell = cell_of(adapter, driver)
    cell.stream()
    yield cell
    driver.close()


def seen(cell, state):
    """Bytes cross a serial line in their own time; bench time waits for them."""
    for _ in range(POLLS):
        cell.driver.poll(cell.t)
        if cell.driver.health.bus is state:
            return
        os.sched_yield()
    pytest.fail(f"{state} never reached the driver: {cell.driver.health}")


def arrived(cell):
    """One period whose samples have all arrived."""
    before = cell.driver.health.pairs
    cell.step()
    for _ in range(POLLS):
        cell.driver.poll(cell.t)
        # The last sample's second half may leave in the next period.
        if cell.driver.health.pairs >= before + 7:
            return
        os.sched_yield()
    pytest.fail(f"the period's samples never arrived: {cell.driver.health}")


def test_a_thousand_samples_a_second_cross_the_serial_line_without_a_gap(cell):
    before = cell.driver.health.pairs
    for _ in range(125):
        arrived(cell)
        assert cell.driver.read(cell.t).freshness is Freshness.OK
    assert cell.driver.health.pairs - before >= 1000
    assert cell.driver.health.gaps == cell.driver.health.torn == 0


@pytest.mark.parametrize(
    ("letter", "counters", "state"),
    [("w", (96, 0), BusState.WARNING), ("p", (0, 128), BusState.PASSIVE)],
)
def test_the_driver_and_the_kernel_agree_on_the_controllers_state(
    cell, adapter, letter, counters, state
):
    adapter.state(letter, *counters)
    seen(cell, state)
    assert adapter.link_state == state


def test_an_error_warning_does_not_stop_readings(cell, adapter):
    adapter.state("w", 96, 0)
    seen(cell, BusState.WARNING)
    arrived(cell)
    assert cell.driver.read(cell.t).freshness is Freshness.OK


def test_error_passive_stops_readings_until_it_has_gone_and_the_bus_is_good(cell, adapter):
    adapter.state("p", 0, 128)
    seen(cell, BusState.PASSIVE)
    for _ in range(10):
        arrived(cell)
        with pytest.raises(BusFaultError, match="error-passive"):
            cell.driver.read(cell.t)
    adapter.state("a", 0, 0)
    seen(cell, BusState.ACTIVE)
    with pytest.raises(BusFaultError, match="since error-passive"):
        cell.driver.read(cell.t)
    for _ in range(5):
        arrived(cell)
    assert cell.driver.read(cell.t).freshness is Freshness.OK


def test_bus_off_ends_with_the_interface_taken_down_and_up_and_enough_good_frames(cell, adapter):
    adapter.state("b", 0, 255)
    seen(cell, BusState.OFF)
    assert adapter.link_state == BusState.OFF
    for _ in range(3):
        cell.step()
        with pytest.raises(BusFaultError, match="bus-off"):
            cell.driver.read(cell.t)
    adapter.link("down")
    cell.driver.poll(cell.t)
    adapter.link("up")
    adapter.on_bus = True
    arrived(cell)
    with pytest.raises(BusFaultError, match="since bus-off"):
        cell.driver.read(cell.t)
    for _ in range(5):
        arrived(cell)
    assert cell.driver.read(cell.t).freshness is Freshness.OK
    assert adapter.link_state == BusState.ACTIVE
