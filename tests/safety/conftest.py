"""One assembly under one fault, on a cell whose parts lie close together."""

import pytest

from hil.cell.faults.event import event
from hil.cell.faults.schedule import Fault, Schedule
from hil.cell.faults.span import Span
from hil.cell.faults.trigger import AT_ONCE, Trigger
from hil.trial.fmea import load
from hil.trial.trial import run_trial
from hil.trial.verdict import Verdict
from hil_fixtures.testbed import shipped

RIG = shipped("ffc_short")
ENTRIES = load()
LONGEST = 15.0
"""Bench seconds; a sound assembly takes 11.6."""
LAST = object()


def assembly(kind, params=None, at="phase: pick up", after=40, cycles=None, policy="pose", rig=RIG):
    """A trial under one fault, so many control periods after an event."""
    begins = Trigger(event=event("event", at), offset=Span(cycles=after)) if at else AT_ONCE
    lasts = None if cycles is None else Span(cycles=cycles)
    faults = Schedule((Fault(kind, params or {}, begins, lasts),))
    return run_trial(rig, 1, faults, policy=policy, longest=LONGEST, back=False)


def safe(trial):
    """The fault happened, every always-on monitor held, nothing hung or crashed."""
    return trial.verdict is Verdict.PASSED


def stopped(trial):
    """Safe, noticed, and at rest within the budget of the FMEA file."""
    if not safe(trial):
        return False
    found = trial.faults[0]
    budget = ENTRIES[found.kind].budget_ms * 1e-3
    known = found.detection is not None and found.stop is not None
    return known and found.detection <= budget and found.stop <= budget


def _told(reason):
    """Whether the user reads this, and the arm stands within the budget."""
    return lambda trial: stopped(trial) and reason in trial.reason


class Law:
    """What holds under a fault, and no longer does without one behaviour of the near side."""

    def __init__(self, monkeypatch):
        self._monkeypatch = monkeypatch

    def stops(self, without, kind, params=None, *, told="", **when):
        """The arm is at rest within its budget, and the user is told so."""
        return self.holds(_told(told), without, kind, params, **when)

    def holds(self, shown, without, kind, params=None, **when):
        """Safe, and `shown`."""
        sound = assembly(kind, params, **when)
        assert safe(sound) or sound.verdict is Verdict.BLOCKED, f"{sound.verdict}: {sound.reason}"
        assert shown(sound), f"{sound.reason}; {sound.faults}"
        with self._monkeypatch.context() as patch:
            without(patch)
            broken = assembly(kind, params, **when)
        shows = (safe(broken) or broken.verdict is Verdict.BLOCKED) and shown(broken)
        assert not shows, f"the same without the behaviour: {broken.reason}"
        return sound


@pytest.fixture
def law(monkeypatch):
    return Law(monkeypatch)
