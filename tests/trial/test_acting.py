"""Faults that a plain assembly has no part for, or that were never seen acting: they act here."""

import pytest

from hil.cell.errors import FaultError
from hil.cell.faults.parse import schedule
from hil.trial.trial import run_trial
from hil.trial.verdict import Verdict
from hil_fixtures.testbed import shipped


def tried(kind, phase, policy="pose", rig="ffc_ur5", seed=1, **params):
    trigger = {"event": f"phase: {phase}"}
    faults = schedule([{"kind": kind, "trigger": trigger, "params": params}])
    return run_trial(shipped(rig), seed, faults, policy=policy, longest=60.0)


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


def test_a_parallel_learner_that_lost_an_agent_keeps_the_run_safe():
    trial = tried("L3", "search", "wdql", rig="ffc_learning", seed=6)
    assert trial.verdict is Verdict.PASSED, trial.reason


def test_a_policy_that_does_not_learn_has_no_agents_to_lose():
    with pytest.raises(FaultError, match="no parallel learner"):
        tried("L3", "search")
