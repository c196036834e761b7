"""Importing a package costs what it needs and no more."""

import subprocess
import sys

import pytest

HEAVY = {"numpy", "mujoco", "can", "pydantic", "pint", "matplotlib", "scipy", "numba", "rich"}


def loaded_by(module):
    """Heavy packages that a fresh interpreter has loaded after importing a module."""
    look = f"import sys, {module}; print(*({HEAVY!r} & set(sys.modules)))"
    out = subprocess.run([sys.executable, "-c", look], capture_output=True, text=True, check=True)
    return set(out.stdout.split())


@pytest.mark.parametrize(
    "module",
    ["hil", "hil.cell", "hil.cli.main", "hil_fixtures", "drivers", "drivers.interfaces",
     "drivers.protocol.rtde", "drivers.protocol.nrs_sample", "drivers.ur.arm"],
)  # fmt: skip
def test_an_import_of_names_and_words_loads_nothing_heavy(module):
    assert loaded_by(module) == set()


def test_the_sensor_driver_needs_its_bus_and_nothing_else():
    assert loaded_by("drivers.nrs.can_sensor") <= {"can"}


def test_a_cell_is_assembled_without_its_physics_until_one_is_built():
    assert not {"mujoco", "numba", "matplotlib"} & loaded_by("hil.cell.assemble")
