from pathlib import Path

import pytest

from hil.app.run import Request, Result, run
from hil.cell.rig import Rig
from hil_fixtures.testbed import shipped


@pytest.fixture
def rig() -> Rig:
    return shipped("ffc_ur5")


@pytest.fixture
def perform(rig: Rig, tmp_path: Path):
    """Runs one assembly with a recording; another folder each time."""

    def perform(seed: int = 1, watch=lambda *_: None, **choices: str) -> Result:
        out = tmp_path / str(len(list(tmp_path.iterdir())))
        request = Request(rig, b"rig", seed, "FFC1", out=out, **choices)
        return run(request, watch)

    return perform
