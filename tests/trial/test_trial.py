"""A run without faults, and what the monitors say of traces that break them."""

import numpy as np
import pytest

from hil.monitors.errors import MonitorError
from hil.trial.always import monitors
from hil.trial.signals import NAMES
from hil.trial.trace import Trace
from hil.trial.trial import run_trial
from hil.trial.verdict import Judge, Verdict, judge
from hil_fixtures.testbed import shipped


@pytest.fixture(scope="module")
def rig():
    return shipped("ffc_ur5")


@pytest.fixture(scope="module")
def sound(rig):
    return run_trial(rig, 1)


def test_a_run_without_faults_passes_with_every_monitor_in_its_favour(sound):
    assert sound.verdict is Verdict.PASSED
    assert sound.outcome.kind.value == "inserted"
    assert not sound.violations
    assert sound.worst > 0.0 or sound.robustness["commands"] == 0.0


def test_the_same_run_has_the_same_digest_and_another_seed_another(rig, sound):
    assert run_trial(rig, 1).digest == sound.digest
    assert run_trial(rig, 2).digest != sound.digest


def test_the_true_push_on_a_still_tool_in_free_air_is_nothing(sound):
    trace = sound.trace
    tare = np.array([phase == "tare" for phase in trace.phases])
    for name in ("fx", "fy", "fz"):
        assert abs(trace[name][tare]).max() < 0.02


def test_the_true_push_in_contact_is_what_the_force_law_was_told(sound):
    trace = sound.trace
    pressed = np.array([phase == "contact" for phase in trace.phases])
    assert trace["fz"][pressed][-1] == pytest.approx(5.0, abs=0.3)


@pytest.fixture
def calm(rig):
    """A trace of 2 s in which an arm stands, and everything is as it should be."""
    count = 250
    columns = {name: np.zeros(count) for name in NAMES}
    columns["t"] = np.arange(1, count + 1) * 8e-3
    for name in ("finite", "safe", "running"):
        columns[name][:] = 1.0
    return Trace(columns, ("search",) * count)


def fallen(rig, trace):
    return {violation.monitor for violation in judge(trace, monitors(rig)).violations}


def test_a_calm_trace_violates_nothing(rig, calm):
    assert fallen(rig, calm) == set()


def _changed(trace, **changes):
    columns = {name: column.copy() for name, column in trace.columns.items()}
    for name, (begin, end, value) in changes.items():
        columns[name][begin:end] = value
    return Trace(columns, trace.phases)


def test_a_force_over_the_bound_may_last_one_cycle_before_the_stop(rig, calm):
    assert fallen(rig, _changed(calm, measured_force=(100, 101, 1.2))) == set()
    assert fallen(rig, _changed(calm, measured_force=(100, 102, 1.2))) == {"F1"}
    stopped = _changed(calm, measured_force=(100, 150, 1.2), stopping=(101, 250, 1.0))
    assert fallen(rig, stopped) == set()


def test_a_true_force_over_the_bound_may_last_as_long_as_its_sample_travels(rig, calm):
    assert fallen(rig, _changed(calm, force=(100, 102, 1.5))) == set()
    assert fallen(rig, _changed(calm, force=(100, 106, 1.5))) == {"F1.true"}


def test_nothing_moves_on_a_command_older_than_its_limit(rig, calm):
    assert fallen(rig, _changed(calm, command_age=(100, 120, 0.2))) == set()
    assert fallen(rig, _changed(calm, command_age=(100, 120, 0.2), speed=(100, 120, 0.05))) == {
        "F2"
    }


def test_a_fault_that_has_to_stop_the_arm_leaves_it_so_long_and_no_longer(rig, calm):
    cycles = round(rig.limits.standstill / (rig.robot.period * 1e-9)) + 1
    moving = _changed(calm, owed=(10, 250, 1.0), speed=(0, 10 + cycles - 1, 0.1))
    assert fallen(rig, moving) == set()
    moving = _changed(calm, owed=(10, 250, 1.0), speed=(0, 10 + cycles + 5, 0.1))
    assert fallen(rig, moving) == {"F3"}


@pytest.mark.parametrize(
    ("name", "value", "monitor"),
    [
        ("finite", 0.0, "finite"),
        ("step", 0.02, "step"),
        ("turn", 0.1, "turn"),
        ("commands", 2.0, "commands"),
    ],
)
def test_one_bad_cycle_is_enough_for_the_other_monitors(rig, calm, name, value, monitor):
    assert monitor in fallen(rig, _changed(calm, **{name: (100, 101, value)}))


def test_a_formula_over_a_signal_that_is_not_there_names_the_nearest(sound):
    with pytest.raises(MonitorError, match="did you mean 'speed'"):
        sound.trace.robustness("sped <= 1")


def test_monitors_in_the_loop_say_what_they_say_of_the_recorded_run(rig, sound):
    again = judge(sound.trace, monitors(rig))
    assert again.robustness == sound.robustness
    assert again.violations == sound.violations


def test_a_monitor_in_the_loop_knows_of_a_violation_in_the_period_in_which_it_falls(rig, calm):
    broken = _changed(calm, measured_force=(100, 102, 1.2), step=(150, 151, 0.02))
    live, known = Judge(monitors(rig)), []
    for row, phase in zip(broken.rows(), broken.phases, strict=True):
        live.step(row, phase)
        known.append({violation.monitor for violation in live.judgement.violations})
    assert not known[100]
    assert known[101] == {"F1"}
    assert {"F1", "step"} <= known[150]
    assert live.judgement == judge(broken, monitors(rig))
