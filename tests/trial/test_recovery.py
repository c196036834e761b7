"""The way back from a fault: who has to find it, how long it takes, and what is called late."""

from functools import partial

import pytest

import drivers.ur.arm
from hil.cell.faults.log import FaultEvent, Stage
from hil.cell.faults.parse import schedule
from hil.cell.faults.schedule import Fault
from hil.experiments.faults.run import lost
from hil.trial.figures import Figures
from hil.trial.fmea import load
from hil.trial.recovery import wanted
from hil.trial.trial import run_trial
from hil.trial.verdict import Verdict
from hil_fixtures.testbed import shipped

FMEA = load()
SLOW = partial(pytest.param, marks=pytest.mark.campaign)


def struck(kind, phase="search", **params):
    """A short assembly in which one thing goes wrong in the search."""
    trigger = {"event": f"phase: {phase}", "offset": "+3 cycles"}
    faults = schedule([{"kind": kind, "trigger": trigger, "params": params}])
    trial = run_trial(shipped("ffc_short"), 1, faults)
    assert trial.verdict is Verdict.PASSED, trial.reason
    return trial


@pytest.mark.parametrize(
    ("kind", "params"),
    [
        ("R2", {}), ("T5", {}), SLOW("R1", {}), SLOW("R2", {"category": "1"}), SLOW("R10", {}),
        SLOW("C7", {}), SLOW("S6", {"bit": "watchdog"}),
    ],
)  # fmt: skip
def test_the_near_side_comes_back_within_its_budget_from_a_stop_in_contact(kind, params):
    trial = struck(kind, **params)
    assert 1.0 < trial.faults[0].recovery <= FMEA[kind].recovery_ms * 1e-3
    assert not lost(trial.faults, trial.events, FMEA[kind], Fault(kind, params))


def test_a_driver_that_does_not_release_the_stop_does_not_come_back(monkeypatch):
    monkeypatch.setattr(drivers.ur.arm, "release_stop", lambda *_: None)
    trial = struck("R1")
    assert trial.faults[0].recovery is None
    assert lost(trial.faults, trial.events, FMEA["R1"], Fault("R1")) == (
        "R1: ready again never, budget 15000 ms"
    )


def test_drawing_back_is_the_way_back_from_a_collision():
    trial = struck("P4", "approach")
    assert 0.1 < trial.faults[0].recovery <= FMEA["P4"].recovery_ms * 1e-3


@pytest.mark.parametrize("kind", ["T3", "R10"])
def test_a_run_that_lost_its_link_has_the_same_digest_again(kind):
    """Its reason names a port, and the cell goes on while the near side hears of it."""
    first, again = struck(kind), struck(kind)
    assert first.reason != again.reason, "free ports differ"
    assert first.digest == again.digest


def told(*stages, index=0, kind="R1"):
    return [FaultEvent(0, index, kind, stage) for stage in stages]


OVER = told(Stage.ARMED, Stage.ACTIVE, Stage.CLEARED)


@pytest.mark.parametrize(
    ("kind", "events", "found"),
    [
        ("R1", OVER, (0,)),
        ("R1", told(Stage.ARMED, Stage.ACTIVE), ()),
        ("R1", told(Stage.ARMED), ()),
        ("P4", OVER, ()),
        ("T7", OVER, ()),
    ],
)
def test_the_way_back_is_wanted_from_what_stopped_the_arm_and_is_over(kind, events, found):
    assert wanted(((0, Fault(kind)),), events, FMEA) == found


def test_nobody_comes_back_with_a_node_that_calls_its_own_gauges_faulty():
    """It does so until somebody restarts it; a campaign had asked for the way back all the same."""
    for bit, found in (("overload", (0,)), ("supply", ())):
        assert wanted(((0, Fault("S6", {"bit": bit})),), OVER, FMEA) == found


def test_nobody_comes_back_while_another_fault_is_in_force():
    both = ((0, Fault("R1")), (1, Fault("C1")))
    standing = told(Stage.ARMED, Stage.ACTIVE, index=1, kind="C1")
    assert wanted(both, [*OVER, *standing], FMEA) == ()


@pytest.mark.parametrize(
    ("kind", "recovery", "events", "said"),
    [
        ("R1", 7.0, OVER, ""),
        ("R1", 16.0, OVER, "R1: ready again after 16000 ms, budget 15000 ms"),
        ("R1", None, OVER, "R1: ready again never, budget 15000 ms"),
        ("R1", None, told(Stage.ACTIVE), ""),
        ("P4", None, told(Stage.ACTIVE), ""),
        ("P4", 3.0, told(Stage.ACTIVE), "P4: ready again after 3000 ms, budget 2000 ms"),
    ],
)
def test_what_is_owed_and_late_is_named(kind, recovery, events, said):
    found = Figures(kind, 0, 4.0, "search", 0.1, 0.1, 0.1, 0.1, 0.0, recovery)
    assert lost([found], events, FMEA[kind], Fault(kind)) == said
