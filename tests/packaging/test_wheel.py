"""The wheel as a user gets it: every package, every data file, and no name of somebody else's."""

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ROOMS = {"controller": "controller", "drivers": "drivers", "fixtures": "hil_fixtures",
         "hil": "hil", "learner": "learner"}  # fmt: skip
"""Name in the wheel by folder of the source tree."""
BESIDES = ("pyproject.toml", "README.md", "LICENSE")
IGNORED = shutil.ignore_patterns("__pycache__")


def shipped_sources():
    """Every file of the rooms, under its name in the wheel."""
    for folder, name in ROOMS.items():
        for path in (ROOT / folder).rglob("*"):
            if path.is_file() and "__pycache__" not in path.parts:
                yield f"{name}/{path.relative_to(ROOT / folder).as_posix()}"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Built from a copy, so that no earlier build's leftovers get in."""
    tree = tmp_path_factory.mktemp("tree")
    for folder in ROOMS:
        shutil.copytree(ROOT / folder, tree / folder, ignore=IGNORED)
    for path in filter(Path.exists, (ROOT / name for name in BESIDES)):
        shutil.copy(path, tree)
    out = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "wheel", "--quiet"]
    options = ["--no-deps", "--no-build-isolation", "--no-index", "--wheel-dir", str(out)]
    subprocess.run([*command, *options, str(tree)], check=True)
    return next(out.glob("*.whl"))


@pytest.fixture(scope="module")
def contents(wheel):
    with zipfile.ZipFile(wheel) as archive:
        return {name for name in archive.namelist() if not name.endswith("/")}


def test_no_package_of_another_projects_name_is_in_it(contents):
    tops = {name.split("/")[0] for name in contents}
    metadata = {top for top in tops if top.endswith(".dist-info")}
    assert tops - metadata == set(ROOMS.values())
    assert len(metadata) == 1


def test_every_source_file_of_the_tree_is_in_it(contents):
    assert set(shipped_sources()) - contents == set()


def test_nothing_is_in_it_that_is_not_in_the_tree(contents):
    code = {name for name in contents if ".dist-info/" not in name}
    assert code - set(shipped_sources()) == set()


@pytest.mark.parametrize(
    "name",
    [
        "hil_fixtures/rigs/ffc_ur5.yaml",
        "drivers/protocol/nrs.dbc",
        "drivers/ur/servo.script",
        "hil/cell/arm/urscript/grammar.lark",
    ],
)
def test_what_is_read_at_run_time_is_in_it(contents, name):
    assert name in contents


def test_licence_and_command_come_with_it(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        entry_points = next(name for name in names if name.endswith("entry_points.txt"))
        assert "hil = hil.cli.main:main" in archive.read(entry_points).decode()
    assert any(name.endswith("licenses/LICENSE") for name in names)


def test_the_wheel_is_for_any_machine(wheel):
    assert wheel.name.endswith("-py3-none-any.whl")
