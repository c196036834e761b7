"""One row of the compatibility table: a call, what it must do, and from which version on."""

import time
from collections.abc import Callable, Mapping
from typing import NamedTuple

from expect import near
from robot import Robot

Check = Callable[[Robot], object]


class Case(NamedTuple):
    """A check of a call's effect; it raises AssertionError when the effect is missing.

    since: first CB3 and first e-Series version (major, minor) in which the client does more than
    return. idle: the bare call, made below that version; below: what the client then does.
    bug: what is wrong with the client's call, on any controller.
    """

    check: Check
    since: tuple[tuple[int, int], tuple[int, int]] = ((3, 0), (5, 0))
    idle: Check | None = None
    bug: str = ""
    below: str = "the client leaves the call out of its script"


NEVER = (4, 0)
"""A CB3 version that does not exist: the call is e-Series only."""

Cases = Mapping[str, Case]
"""Rows of one interface by method name; a word in brackets tells variants of a method apart."""


class Verdict(NamedTuple):
    """What a row came to: pass, no effect, client bug or FAIL, and why."""

    result: str
    reason: str = ""


def judge(case: Case, robot: Robot) -> Verdict:
    """Run one case; whatever it raises is its reason."""
    first = case.since[0] if robot.version[0] == 3 else case.since[1]
    try:
        if robot.version < first:
            return _without_effect(case, robot, first)
        case.check(robot)
    except Exception as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        return Verdict("client bug", case.bug) if case.bug else Verdict("FAIL", reason)
    return Verdict("pass")


def _without_effect(case: Case, robot: Robot, first: tuple[int, int]) -> Verdict:
    """The call returns, the arm stands where it stood, and the control script goes on."""
    assert case.idle is not None, "a case with a first version names its bare call"
    before = robot.receive.getActualQ()
    case.idle(robot)
    time.sleep(0.1)
    near(robot.receive.getActualQ(), before, 0.5e-3)
    assert robot.control.isProgramRunning(), "the call ended the control script"
    since = "e-Series only" if first == NEVER else f"from {first[0]}.{first[1]} on"
    return Verdict("no effect", f"{since}: {case.below}")
