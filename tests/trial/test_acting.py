"""Faults that a plain assembly has no part for, or that were never seen acting: they act here."""

import pytest

from hil.cell.errors import FaultError
from hil.cell.faults.parse import schedule
from hil.trial.trial import run_trial
from hil.trial.verdict import Verdict
from hil_fixtures.testbed import shipped


def tried(kind, phase, policy="pose", rig="ffc_ur5", longest=60.0, **params):
    trigger = {"event": f"phase: {phase}"}
    faults = schedule([{"kind": kind, "trigger": trigger, "params": params}])
    return run_trial(shipped(rig), 1, faults, policy=policy, longest=longest)


@pytest.mark.parametrize(
    ("kind", "phase", "params", "answer"),
    [
        ("R5", "search", {}, "protective stop"),
        ("T8", "search", {"field": "type", "direction": "to_cell"}, "fell silent"),
        ("T8", "search", {"field": "payload", "direction": "to_cell"}, ""),
        ("G1", "search", {"what": "slip"}, ""),
        ("H4", "insert", {}, "goal depth reached"),
    ],
)
def test_it_acts_and_the_run_stays_safe(kind, phase, params, answer):
    trial = tried(kind, phase, **params)
    assert trial.verdict is Verdict.PASSED, trial.reason
    assert "active" in {event.stage.value for event in trial.events}
    assert answer in trial.reason


@pytest.mark.parametrize(("kind", "params"), [("L3", {}), ("L4", {"what": "wrong_model"})])
def test_a_parallel_learner_in_pieces_keeps_the_run_safe(kind, params):
    trial = tried(kind, "search", "wdql", rig="ffc_learning", **params)
    assert trial.verdict is Verdict.PASSED, trial.reason


def test_a_blocked_slot_is_given_up_as_a_danger():
    rig = shipped("ffc_ur5")
    few = rig.model_copy(update={"task": rig.task.model_copy(update={"max_jams": 1})})
    trigger = {"event": "phase: insert"}
    trial = run_trial(few, 1, schedule([{"kind": "P3", "trigger": trigger}]))
    assert trial.verdict is Verdict.PASSED, trial.reason
    assert trial.outcome.kind.value == "danger"
    assert trial.outcome.reason == "stuck in the slot 2 times"


def test_a_policy_that_does_not_learn_has_no_agents_to_lose():
    with pytest.raises(FaultError, match="no parallel learner"):
        tried("L3", "search")
