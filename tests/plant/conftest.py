from pathlib import Path

import pytest

from hil.cell.rig import Rig, load


@pytest.fixture(scope="session")
def rig() -> Rig:
    return load(Path(__file__).parents[2] / "fixtures" / "rigs" / "ffc_ur5.yaml")
