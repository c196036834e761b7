"""A cell in a process of its own, on a loopback address of its own: what a robot is to a client.

ur_rtde calls fixed ports (29999, 30003, 30004), so the address is what keeps two cells apart.
"""

import contextlib
import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import IO, NamedTuple

HIL = str(Path(sys.executable).with_name("hil"))
RIGS = {"cb3": "plate_ur5", "e-series": "plate_ur5e"}
ENDING = 20.0
"""Longest that a cell may take to end after SIGINT, s."""


class Cell(NamedTuple):
    """Where a served cell is, what it is, and its process."""

    host: str
    version: str
    home: tuple[float, ...]
    pid: int


def own_address(index: int) -> str:
    """A loopback address of this process; `index` (0 to 3) tells its cells apart."""
    pid = os.getpid()
    return f"127.{16 + (pid >> 14) % 200}.{(pid >> 6) & 255}.{1 + (pid & 63) * 4 % 252 + index}"


@contextlib.contextmanager
def served(rig: str, host: str | None) -> Iterator[Cell]:
    """`hil up RIG` by the wall clock until the block ends; on the rig's own host for None."""
    shown = subprocess.run(
        [HIL, "rig", "show", rig, "--json"], capture_output=True, text=True, check=True
    )
    robot = json.loads(shown.stdout)["robot"]
    command = [HIL, "up", rig, "--json", *([] if host is None else ["--host", host])]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
        try:
            _wait_for_doors(child.stdout)
            home = tuple(float(str(q).removesuffix("rad")) for q in robot["home"])
            yield Cell(host or robot["host"], robot["version"], home, child.pid)
        finally:
            _end(child)


def _wait_for_doors(out: IO[str] | None) -> None:
    """Read until the JSON object that a cell prints when its doors are open is complete."""
    assert out is not None
    text = ""
    while not text.endswith("}\n"):
        line = out.readline()
        if not line:
            raise SystemExit("the cell ended before its doors were open; it said why above")
        text += line


def _end(child: subprocess.Popen[str]) -> None:
    child.send_signal(signal.SIGINT)
    try:
        child.wait(ENDING)
    except subprocess.TimeoutExpired:
        child.kill()
