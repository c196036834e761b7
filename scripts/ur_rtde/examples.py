"""ur_rtde's Python examples, unchanged but for the robot's address, against both series.

    python scripts/ur_rtde/examples.py SOURCE      # the unpacked source distribution

Endless ones (servo circle, recorder) are ended by Ctrl-C after a while, as a user would.
"""

import argparse
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from cell import RIGS, Cell, own_address, served
from robot import Robot

HOSTS = re.compile(r'"(?:127\.0\.0\.1|localhost|192\.168\.56\.101)"|\'localhost\'')
ENDLESS = {"realtime_control_example.py": 6.0, "record_data_example.py": 3.0}
"""Seconds after which each is interrupted."""
LEFT_OUT = {
    "joint_pd_torque_control.py": "needs direct torque, software 5.26",
    "test_external_control.py": "needs a program on the pendant that runs the URCap",
    "move_until_contact.py": "on CB3: needs tool_contact, software 5.4",
}
LIMIT = 90.0


def _run(example: Path, cell: Cell) -> str:
    """How one example ended."""
    text = HOSTS.sub(f'"{cell.host}"', example.read_text())
    with tempfile.TemporaryDirectory() as folder:
        own = Path(folder) / example.name
        own.write_text(text)
        command = [sys.executable, str(own)]
        with subprocess.Popen(
            command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        ) as child:
            said, in_time = _ended(child, ENDLESS.get(example.name))
    if not in_time:
        return "FAIL: did not end"
    complaint = next((line for line in said.splitlines() if "not running" in line), "")
    return f"FAIL: {said[-300:]}" if child.returncode or complaint else "pass"


def _ended(child: subprocess.Popen[str], interrupt_after: float | None) -> tuple[str, bool]:
    """What a child said, and whether it ended in time."""
    try:
        return child.communicate(timeout=interrupt_after or LIMIT)[0], True
    except subprocess.TimeoutExpired:
        child.send_signal(signal.SIGINT if interrupt_after else signal.SIGKILL)
    try:
        return child.communicate(timeout=10.0)[0], interrupt_after is not None
    except subprocess.TimeoutExpired:
        child.kill()
        return child.communicate()[0], False


def _bring_up(cell: Cell) -> None:
    """An example takes a robot that is ready for granted."""
    robot = Robot(cell.host, (3, 0), cell.home)
    robot.power_up()
    robot.close()


def main() -> int:
    """Exit status 1 when an example fails."""
    parser = argparse.ArgumentParser(description="ur_rtde's Python examples, both series")
    parser.add_argument("source", type=Path, help="unpacked ur_rtde source distribution")
    # A shell's background job ignores Ctrl-C, and so would the examples it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    found = sorted((parser.parse_args().source / "examples" / "py").glob("*.py"))
    if not found:
        parser.error("no examples/py/*.py there")
    failed = False
    for index, (series, rig) in enumerate(RIGS.items()):
        for example in found:
            why = LEFT_OUT.get(example.name, "")
            if why and (series == "cb3" or not why.startswith("on CB3")):
                print(f"{series:9} {example.name:36} left out: {why}", flush=True)
                continue
            with served(rig, own_address(index)) as cell:
                _bring_up(cell)
                result = _run(example, cell)
            failed |= result != "pass"
            print(f"{series:9} {example.name:36} {result}", flush=True)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
