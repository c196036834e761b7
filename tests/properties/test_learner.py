"""The safety layer carries safety, not the policy."""

from hypothesis import HealthCheck, Phase, given, settings

from hil.cell.rig import parse
from hil.trial.trial import run_trial
from hil_fixtures import strategies as hs

RIG = parse(
    """
name: cable
robot:
  model: ur5
  series: cb3
  home: [0.0 deg, -98.4 deg, 118.9 deg, -110.5 deg, -90.0 deg, 90.0 deg]
can: {interface: virtual}
sensor: {boot_time: 8 ms}
connector: {position: [-450 mm, -110 mm, 50 mm]}
fixture: {parts: [{name: FFC1, position: [-430 mm, -130 mm, 55 mm]}]}
task: {start_cells: [2, 3, 1], on_jam: step on}
"""
).on_free_ports()


@settings(
    max_examples=3, deadline=None, derandomize=True, database=None, phases=[Phase.generate],
    suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip
@given(hs.learner_actions(max_size=16))
def test_no_sequence_of_actions_trips_an_always_on_monitor(actions):
    trial = run_trial(RIG, 1, policy=actions)
    assert trial.violations == ()
    assert trial.verdict == "passed", trial.reason
