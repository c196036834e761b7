"""ur_rtde 1.6.5, a client this project did not write, against `hil up` in a process of its own."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parents[2] / "scripts" / "ur_rtde"
TABLE = SCRIPTS / "compatibility.py"
ALLOWED = {"pass", "no effect", "client bug"}

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="only Linux answers on all of 127/8"),
    pytest.mark.timeout(1200),
]
pytest.importorskip("rtde_control", reason="ur_rtde has no wheel for this Python")


def verdicts(series, *options):
    """Result and reason by row."""
    command = [sys.executable, str(TABLE), "--series", series, "--json", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.stdout, done.stderr
    return json.loads(done.stdout)[series]


def failures(rows):
    return {row: reason for row, (result, reason) in rows.items() if result not in ALLOWED}


@pytest.mark.parametrize("series", ["cb3", "e-series"])
def test_ur_rtde_moves_pushes_and_switches_the_emulated_arm(series):
    assert not failures(verdicts(series, "--quick"))


def test_every_method_of_the_installed_client_has_a_row():
    ask = "import cases, json; print(json.dumps(cases.without_a_row() + cases.of_no_method()))"
    done = subprocess.run(
        [sys.executable, "-c", ask], cwd=SCRIPTS, capture_output=True, text=True, check=True
    )
    assert json.loads(done.stdout) == []


@pytest.mark.campaign
@pytest.mark.parametrize("series", ["cb3", "e-series"])
def test_every_call_of_ur_rtde_has_its_effect(series):
    rows = verdicts(series)
    control = [row for row in rows if row.startswith("RTDEControlInterface")]
    working = [row for row in control if rows[row][0] in {"pass", "no effect"}]
    assert len(working) >= 0.95 * len(control)
    assert not failures(rows)
