"""Campaigns on a dask scheduler elsewhere; in processes of their own, as dask's threads stay."""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("distributed")
SCRIPT = Path(__file__).with_name("remote.py")


def remote(ledger, code=""):
    ended = subprocess.run(
        [sys.executable, str(SCRIPT), str(ledger), code], capture_output=True, text=True, check=True
    )
    return ended.stdout.splitlines()[-1]


def test_workers_elsewhere_give_every_run_its_verdict(tmp_path):
    expected = ["passed"] * 25
    expected[5], expected[17] = "failed", "crash"
    assert remote(tmp_path / "a.db").split() == expected


def test_workers_with_other_code_are_refused(tmp_path):
    assert remote(tmp_path / "a.db", "v9").endswith("this campaign v9; update it")


def test_an_address_that_is_none_is_one_clear_line_and_status_2():
    line = "experiment insertion --seeds 1 --scheduler carrier-pigeon://nowhere"
    ended = subprocess.run(
        [sys.executable, "-c", "from hil.cli.main import main; main()", *line.split()],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (ended.returncode, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    assert ended.stderr.startswith("hil: no dask scheduler answers at carrier-pigeon://nowhere")
