"""A violation, from the search for it to a test of a user's that keeps it from coming back."""

import subprocess
import sys

import pytest
import yaml

from hil.cli.main import call
from hil.cli.shipped import find

NEVER_STOPPED = "not (running > 0.5 and stopping > 0.5)"
"""What a lost bus violates and a sound run does not: the job comes to its own end."""


@pytest.fixture
def repository(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cable.yaml").write_text(find("ffc_short").read_text())
    return tmp_path


def kept():
    """What pytest says of the file, in a process of its own."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "hil_fixtures.plugin"]
    command += ["-p", "no:cacheprovider", "found.regression.yaml"]
    return subprocess.run(command, capture_output=True, text=True, timeout=240, check=False)


def test_what_a_search_finds_is_shrunk_replayed_and_kept_as_a_test(repository, capsys):
    search = ("falsify", "cable.yaml", "--faults", "can.drop", "--formula", NEVER_STOPPED)
    assert call((*search, "--budget", "8")) == 1
    assert call(("shrink", "found.regression.yaml", "--budget", "2")) == 0
    assert call(("replay", "found.regression.yaml")) == 1
    assert "violated: not (running" in capsys.readouterr().out
    said = kept().stdout
    assert "1 failed" in said
    assert f"rerun: hil replay {repository / 'found.regression.yaml'}" in said


def test_a_kept_schedule_passes_once_nothing_is_violated(repository):
    content = {"rig": "cable.yaml", "seed": 1, "policy": "pose", "formula": "force <= 1"}
    fault = {"kind": "C1", "trigger": {"event": "phase: pick up"}}
    (repository / "found.regression.yaml").write_text(
        yaml.safe_dump({**content, "faults": [fault]})
    )
    assert "1 passed" in kept().stdout
