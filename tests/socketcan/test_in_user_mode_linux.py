"""The tests that need kernel CAN, on a machine whose kernel has none: a second kernel runs them."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from hil.cell.sensor.can_interfaces import up_can_interfaces

ROOT = Path(__file__).parents[2]
NOT_INSTALLED = 125
LIMIT = 900
"""Seconds; about 100 on two idle cores."""
FOLDERS = ("tests/socketcan", "tests/nrs", "tests/sensor", "tests/contract")


@pytest.mark.skipif(bool(up_can_interfaces()), reason="kernel CAN is up: the tests run right here")
@pytest.mark.timeout(LIMIT + 60)
def test_everything_that_needs_kernel_can_passes_in_user_mode_linux():
    pytest_inside = [sys.executable, "-m", "pytest", "-m", "socketcan", "-q", "-rfEs", *FOLDERS]
    with subprocess.Popen(
        [ROOT / "scripts" / "vcan", *pytest_inside],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {"NO_COLOR": "1"},
        start_new_session=True,
    ) as child:
        try:
            output, _ = child.communicate(timeout=LIMIT)
        finally:
            if child.poll() is None:
                os.killpg(child.pid, signal.SIGTERM)
    if child.returncode == NOT_INSTALLED:
        pytest.skip(f"kernel CAN was not tested: {output.strip()}")
    assert child.returncode == 0, output
    (passed,) = re.findall(r"(\d+) passed", output)
    assert int(passed) > 50, output
    print(output.splitlines()[-1])
