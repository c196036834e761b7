"""How `hil up` lasts: ur_rtde servoing in contact, e-Series at 500 Hz, for so many minutes.

    python scripts/ur_rtde/soak.py --minutes 30

Every 10 s a second client connects, reads and leaves, and every minute the control interface
reconnects. Prints reconnects, force, and the cell's memory in the first and the last quarter.
"""

import argparse
import math
import sys
import time
from pathlib import Path
from statistics import fmean, median
from typing import NamedTuple

from cell import Cell, own_address, served
from robot import CONTACT, Robot
from rtde_receive import RTDEReceiveInterface

RIG = "plate_ur5e"
DEPTH = 1.0e-3
"""Mean depth in the plate, m: 10 N; the servo swings it by half of that, once a second."""
GROWTH = 0.02
"""Largest growth of memory from the first to the last quarter."""


class Tally(NamedTuple):
    """memory: resident set of the cell, KiB, once a second; pushes: force then, N."""

    memory: list[int]
    pushes: list[float]
    visits: list[bool]
    reconnects: list[bool]


def resident(pid: int) -> int:
    """KiB of memory that a process holds."""
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1])
    raise SystemExit(f"process {pid}: /proc says no VmRSS")


def work(robot: Robot, cell: Cell, minutes: float) -> Tally:
    """Servo in contact until the time is over."""
    tally = Tally([], [], [], [])
    begin = time.monotonic()
    second = 0
    while (passed := time.monotonic() - begin) < 60 * minutes:
        start = robot.control.initPeriod()
        swing = 0.5 * DEPTH * math.sin(math.tau * passed)
        pose = [-0.40, -0.11, CONTACT - DEPTH + swing, math.pi, 0.0, 0.0]
        if not robot.control.servoL(pose, 0.5, 0.5, robot.step, 0.1, 300):
            robot.restart_script()
        robot.control.waitPeriod(start)
        if passed >= second + 1:
            second += 1
            tally.memory.append(resident(cell.pid))
            tally.pushes.append(robot.push())
            _disturb(robot, second, tally)
    robot.control.servoStop()
    return tally


def _disturb(robot: Robot, second: int, tally: Tally) -> None:
    """A visitor every 10 s, a new control connection every 60 s."""
    if second % 10 == 0:
        visitor = RTDEReceiveInterface(robot.host)
        tally.visits.append(visitor.isConnected() and visitor.getTimestamp() > 0)
        visitor.disconnect()
    if second % 60 == 0:
        robot.control.servoStop()
        robot.control.disconnect()
        tally.reconnects.append(robot.control.reconnect())
        robot.restart_script()


def report(tally: Tally) -> bool:
    """Print the figures; true when all connections worked and memory did not grow."""
    quarter = max(1, len(tally.memory) // 4)
    first, last = fmean(tally.memory[:quarter]), fmean(tally.memory[-quarter:])
    growth = last / first - 1.0
    print(f"visits {sum(tally.visits)}/{len(tally.visits)}")
    print(f"reconnects {sum(tally.reconnects)}/{len(tally.reconnects)}")
    print(f"push {median(tally.pushes):.2f} N median of {len(tally.pushes)}")
    print(
        f"memory {first / 1024:.1f} MiB first quarter, {last / 1024:.1f} MiB last ({growth:+.2%})"
    )
    return all(tally.visits) and all(tally.reconnects) and growth < GROWTH


def main() -> int:
    """Exit status 1 when a connection failed or memory grew by 2 % or more."""
    parser = argparse.ArgumentParser(description="ur_rtde servoing in contact for a long time")
    parser.add_argument("--minutes", type=float, default=30.0)
    minutes = parser.parse_args().minutes
    with served(RIG, own_address(3)) as cell:
        robot = Robot(cell.host, (5, 11), cell.home)
        robot.ready()
        robot.hover()
        tally = work(robot, cell, minutes)
        robot.close()
    return 0 if report(tally) else 1


if __name__ == "__main__":
    sys.exit(main())
