"""The lock file that `make setup` installs from answers to pyproject.toml."""

import re
import tomllib
from itertools import chain
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
BASELINES = (ROOT / "requirements-baselines.txt").read_text("utf-8")
LOCK = (ROOT / "requirements.lock").read_text("utf-8")
PIN = re.compile(r"^([A-Za-z0-9._-]+)==([^\s;\\]+)", re.MULTILINE)


def required():
    project = PROJECT["project"]
    lists = [project["dependencies"], PROJECT["build-system"]["requires"]]
    lists += project["optional-dependencies"].values()
    requirements = map(Requirement, chain.from_iterable(lists))
    return [one for one in requirements if one.name != project["name"]]  # an extra made of extras


@pytest.fixture(scope="module")
def pinned():
    """Versions by name; a package may be pinned once for each Python, torch in its own file."""
    versions = {}
    for name, version in PIN.findall(LOCK) + PIN.findall(BASELINES):
        versions.setdefault(canonicalize_name(name), []).append(version)
    return versions


@pytest.mark.parametrize("requirement", required(), ids=str)
def test_every_requirement_is_pinned_to_a_version_that_it_allows(pinned, requirement):
    versions = pinned.get(canonicalize_name(requirement.name), [])
    assert versions, f"{requirement.name} is not in the lock file; run `make lock`"
    assert all(requirement.specifier.contains(version) for version in versions)


def test_every_pin_has_its_hashes():
    entries = re.split(r"^(?=[A-Za-z0-9._-]+==)", LOCK, flags=re.MULTILINE)[1:]
    assert [entry.split()[0] for entry in entries if "--hash=sha256:" not in entry] == []


def test_the_lock_leaves_torch_to_its_own_file_where_it_is_the_one_for_the_cpu():
    locked, apart = (dict(PIN.findall(text)) for text in (LOCK, BASELINES))
    assert not {"torch", "stable-baselines3"} & set(locked)
    assert apart["torch"].endswith("+cpu")


def test_setup_installs_from_the_lock_file_by_hash():
    recipe = (ROOT / "Makefile").read_text("utf-8")
    assert "--require-hashes --requirement requirements.lock" in recipe
