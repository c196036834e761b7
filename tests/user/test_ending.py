"""A run that is told to stop, or whose cell dies: its ending, and what it leaves."""

import os
import signal
from time import monotonic

import pytest

STRUCK = """
import os, signal, sys
from hil.cli import assembly
from hil.cli.main import main
phase, number = sys.argv.pop(1), int(sys.argv.pop(1))
def watch(cycle, course, cell):
    if course.name == phase:
        os.killpg(0, number)
assembly.ignore = watch
main()
"""
"""`hil` whose whole process group gets a signal in the first period of a phase."""

BRINGING_UP = """
import os, signal, sys
import hil.app.run
from hil.cli.main import main
hil.app.run.bring_up = lambda arm, sensor, load: (arm.connect(), os.killpg(0, signal.SIGINT))
main()
"""

ORPHANED = """
import os, signal
from multiprocessing import active_children
from hil.cli import assembly
from hil.cli.main import main
def watch(cycle, course, cell):
    for child in active_children():
        os.kill(child.pid, signal.SIGKILL)
assembly.ignore = watch
main()
"""
"""`hil` whose cell is killed in the first period of its run."""

RUN = ("run", "ffc_ur5", "--out", "run")


def gone(group: int) -> bool:
    """Whether a group's processes end by themselves, within a bound that no correct run needs.

    Python's resource tracker outlives the process that started it by a few milliseconds.
    """
    end = monotonic() + 10.0
    while not empty(group):
        if monotonic() > end:
            return False
    return True


def empty(group: int) -> bool:
    """Whether no process of a group is left, but for those whose parent has not looked yet."""
    with os.scandir("/proc") as entries:
        for entry in entries:
            if not entry.name.isdigit():
                continue
            try:
                with open(f"/proc/{entry.name}/stat") as file:
                    state, _, owner = file.read().rpartition(")")[2].split()[:3]
            except (FileNotFoundError, ProcessLookupError):
                continue
            if int(owner) == group and state != "Z":
                return False
    return True


@pytest.mark.parametrize(
    ("phase", "layout", "number", "word", "status"),
    [
        ("pick up", "inline", signal.SIGINT, "interrupted", 130),
        ("pick up", "process", signal.SIGINT, "interrupted", 130),
        ("search", "inline", signal.SIGINT, "interrupted", 130),
        ("pick up", "inline", signal.SIGTERM, "terminated", 143),
    ],
)
def test_a_signal_ends_a_run_with_one_line_and_a_readable_rest(
    begin, hil, tmp_path, phase, layout, number, word, status
):
    child = begin(phase, str(int(number)), *RUN, "--cell", layout, script=STRUCK)
    out, said = child.communicate(timeout=60)
    assert (child.returncode, out, said) == (status, "", f"hil: {word}\n")
    assert gone(child.pid)
    assert [path.name for path in (tmp_path / "run").iterdir()] == ["run.mcap.part"]
    assert "the run did not finish" in hil("replay", "run").stdout


def test_a_ctrl_c_while_the_arm_is_brought_up_ends_it_with_one_line(begin):
    child = begin(*RUN, script=BRINGING_UP)
    assert child.communicate(timeout=60) == ("", "hil: interrupted\n")
    assert child.returncode == 130
    assert gone(child.pid)


def test_a_cell_that_is_killed_ends_the_run_with_one_line(begin, tmp_path):
    child = begin(*RUN, "--cell", "process", script=ORPHANED)
    assert child.communicate(timeout=60) == ("", "hil: the cell's process died\n")
    assert child.returncode == 1
    assert gone(child.pid)
    assert [path.name for path in (tmp_path / "run").iterdir()] == ["run.mcap.part"]
