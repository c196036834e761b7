"""The tutorial, executed word for word in an empty repository of a user's."""

import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[2] / "docs" / "first_test.md").read_text(encoding="utf-8")
FILES = dict(re.findall(r"`(test_\w+)\.py`[^`]*:\n\n```python\n(.*?)```", PAGE, re.DOTALL))
_COMMANDS = re.findall(r"\n\.venv/bin/pytest (.*?) (test_\w+)\.py\n", PAGE)
COMMANDS = {name: options.split() for options, name in _COMMANDS}
SHOWN = [
    line
    for block in re.findall(r"```\n(-+ HIL run.*?)```", PAGE, re.DOTALL)
    for line in block.splitlines()
]


@pytest.fixture
def run(pytester, monkeypatch):
    """What the page's own command prints for one of its files."""
    monkeypatch.delenv("PYTEST_ADDOPTS", raising=False)
    monkeypatch.delenv("PYTEST_XDIST_WORKER", raising=False)

    def run(name):
        pytester.makepyfile(**{name: FILES[name]})
        options = ("-p", "hil_fixtures.plugin", "-p", "no:cacheprovider")
        return pytester.runpytest_subprocess(*options, *COMMANDS[name], f"{name}.py", timeout=280)

    return run


def numberless(line):
    """What stays the same when a number of the cell's changes."""
    return re.sub(r"[0-9a-f]{64}|\d[\d.]*", "#", line.strip())


@pytest.mark.parametrize("name", ["test_insertion", "test_lost_samples"])
def test_what_the_page_says_passes_does(run, name):
    run(name).assert_outcomes(passed=1)


def test_the_failure_that_the_page_shows_is_the_one_that_comes(run):
    result = run("test_gentle")
    result.assert_outcomes(failed=1)
    printed = set(map(numberless, result.outlines))
    assert len(SHOWN) > 6
    assert [line for line in SHOWN if numberless(line) not in printed] == []


@pytest.mark.campaign
def test_the_property_test_of_the_page_passes(run):
    run("test_actions").assert_outcomes(passed=1)


def test_every_file_of_the_page_has_a_command_and_every_command_a_file():
    assert set(FILES) == set(COMMANDS)
