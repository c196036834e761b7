"""A policy slower than control (L5): the target is held, and nothing waits."""

from hil.cell.faults.parse import parse
from hil.trial.trial import run_trial
from hil.trial.verdict import Verdict
from hil_fixtures.testbed import shipped

SLOW = "faults:\n- {kind: L5, trigger: {event: 'phase:search'}, params: {delay: 200 ms}}\n"


def test_a_slow_policy_costs_time_and_no_command():
    rig = shipped("ffc_ur5")
    slow = run_trial(rig, 1, parse(SLOW))
    sound = run_trial(rig, 1)
    assert slow.verdict is Verdict.PASSED, slow.reason
    assert [event.stage.value for event in slow.events][:2] == ["armed", "active"]
    assert slow.outcome.kind is sound.outcome.kind
    assert max(slow.trace["command_age"]) == max(sound.trace["command_age"])
    assert len(slow.trace) > len(sound.trace)
