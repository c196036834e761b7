"""The safety layer carries safety, not the policy."""

from hypothesis import HealthCheck, Phase, given, settings

from hil.trial.trial import run_trial
from hil_fixtures import strategies as hs
from hil_fixtures.testbed import shipped

RIG = shipped("ffc_short")


@settings(
    max_examples=3, deadline=None, derandomize=True, database=None, phases=[Phase.generate],
    suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip
@given(hs.learner_actions(max_size=16))
def test_no_sequence_of_actions_trips_an_always_on_monitor(actions):
    trial = run_trial(RIG, 1, policy=actions)
    assert trial.violations == ()
    assert trial.verdict == "passed", trial.reason
