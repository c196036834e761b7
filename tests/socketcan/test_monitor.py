"""`cantools monitor`, a full-screen program, as a third party on the live bus."""

import fcntl
import os
import pty
import re
import signal
import struct
import subprocess
import termios
from contextlib import contextmanager, suppress

import pytest

WANTED = 500
ROWS, COLUMNS = 24, 120


class Monitor:
    """The program on a terminal of its own."""

    def __init__(self, command):
        self._ours, theirs = pty.openpty()
        os.set_blocking(self._ours, False)
        self._size(ROWS)
        self._process = subprocess.Popen(
            command, stdin=theirs, stdout=theirs, stderr=theirs, env=os.environ | {"TERM": "linux"}
        )
        os.close(theirs)
        self._text = ""

    def _size(self, rows):
        fcntl.ioctl(self._ours, termios.TIOCSWINSZ, struct.pack("HHHH", rows, COLUMNS, 0, 0))

    def show(self):
        """Take what was drawn; all text so far."""
        if (code := self._process.poll()) is not None:
            pytest.fail(f"the monitor ended with {code}: {self._text}")
        with suppress(BlockingIOError):
            self._text += os.read(self._ours, 1 << 16).decode(errors="replace")
        return self._text

    def repaint(self):
        """curses draws only what changed; a new size makes it draw the whole line again."""
        self._text = ""
        self._size(ROWS + 6)
        self._process.send_signal(signal.SIGWINCH)

    def close(self):
        if self._process.poll() is None:
            os.write(self._ours, b"q")
        try:
            self._process.wait(30)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        os.close(self._ours)


@contextmanager
def monitor(command):
    one = Monitor(command)
    try:
        yield one
    finally:
        one.close()


@pytest.mark.parametrize(
    "interface", ["udp_multicast", pytest.param("socketcan", marks=pytest.mark.socketcan)]
)
def test_the_monitor_decodes_the_live_bus_without_an_error(can_cell, cantools, dbc, interface):
    with can_cell(interface) as cell:
        options = cell.gateway.address.options()
        command = [*cantools, "monitor", "-i", interface, "-c", options.pop("channel"), str(dbc)]
        options.pop("interface")
        if options:
            command += ["--bus-kwargs", *(f"{key}={value}" for key, value in options.items())]
        with monitor(command) as screen:
            cell.driver.start()
            while "NRS1_TORQUE" not in screen.show():
                cell.step()
                cell.driver.poll(cell.t)
            already = len(cell.sent)
            while len(cell.sent) < already + WANTED:
                cell.step()
                cell.driver.poll(cell.t)
            screen.repaint()
            line = r"Received: (\d+), Discarded: (\d+), Errors: (\d+)"
            while (found := re.search(line, screen.show())) is None:
                pass
    received, discarded, errors = map(int, found.groups())
    assert received > 0
    assert (discarded, errors) == (0, 0)
