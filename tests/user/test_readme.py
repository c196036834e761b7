"""What the README shows works as it stands."""

import re
from pathlib import Path

import pytest

README = Path(__file__).parents[2] / "README.md"


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)


def test_the_first_closed_loop_test_passes():
    (source,) = (block for block in blocks("python") if "def test_" in block)
    scope = {}
    exec(source, scope)
    (test,) = (scope[name] for name in scope if name.startswith("test_"))
    test()


@pytest.mark.parametrize("line", [line for line in blocks("sh")[0].splitlines() if line])
def test_every_option_that_is_shown_exists(hil, line):
    command = line.split("#")[0].split("&&")[-1].split(">")[0].split()[1:]
    words = command[:2] if command[0] in {"rig", "experiment"} else command[:1]
    options = {word for word in command if word.startswith("--")}
    explained = hil(*words, "--help").stdout
    assert all(option in explained for option in options), explained


def test_every_file_that_is_linked_is_there():
    links = re.findall(r"\]\(([\w./-]+)\)|src=\"([\w./-]+)\"", README.read_text(encoding="utf-8"))
    assert all((README.parent / (a or b)).exists() for a, b in links)
