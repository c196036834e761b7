"""Laws of the commands: each holds of a sound near side, and falls with a bug planted in it."""

from math import nan

import pytest

import controller.phases.move as travel
import drivers.ur.arm as driver
from controller.guard import Guard
from drivers.ur.arm import UrArm
from drivers.ur.program import ServoProgram
from hil.cell.faults.parse import schedule
from hil.trial.trial import run_trial
from hil_fixtures.testbed import shipped

SHORT = shipped("ffc_short")
# A turn of the shipped limit is one that the robot's own safety system refuses.
RIG = SHORT.model_copy(update={"limits": SHORT.limits.model_copy(update={"step_rotation": 0.01})})
LINE, TRAVELLED = travel.line, travel.travelled


def fallen(*faults):
    """The monitors that a run violates."""
    begins = {"event": "phase: pick up", "offset": "+40 cycles"}
    broken = schedule([{"trigger": begins, **fault} for fault in faults]) if faults else None
    return {one.monitor for one in run_trial(RIG, 1, broken, longest=15.0).violations}


def rewritten(monkeypatch, words, others):
    """The robot's program with other words in it."""
    text = ServoProgram.text
    monkeypatch.setattr(
        ServoProgram, "text", lambda self, rate: text(self, rate).replace(words, others)
    )
    assert others in ServoProgram().text(125)


# A phase with a bug is stopped by the guard; without its guard the set-point reaches the robot,
# whose program leads the arm there step by step; without that too the arm goes there at once.


def hurried(start_time, speed, acceleration):
    return TRAVELLED(8.0 * start_time, speed, acceleration)


def lost(start, end, fraction):
    return LINE(start, end, fraction)._replace(x=nan)


def twisted(start, end, fraction):
    place = LINE(start, end, fraction)
    return place._replace(theta=place.theta + 0.021) if fraction > 0.5 else place


@pytest.mark.parametrize(
    ("bug", "monitors"),
    [
        ({"travelled": hurried}, {"step", "speed"}),
        ({"line": lost}, {"finite"}),
        ({"line": twisted}, {"turn"}),
    ],
)
def test_a_set_point_beyond_its_bounds_does_not_pass_the_guard(monkeypatch, bug, monitors):
    for name, planted in bug.items():
        monkeypatch.setattr(travel, name, planted)
    assert fallen() == set()
    monkeypatch.setattr(Guard, "check", lambda self, cycle: None)
    monkeypatch.setattr(Guard, "check_setpoint", lambda self, setpoint, stage: None)
    monkeypatch.setattr(driver, "isfinite", lambda value: True)
    rewritten(monkeypatch, "here = towards(target, here)", "here = target")
    assert monitors <= fallen()


PAUSE = {"kind": "H1", "params": {"pause": "0.05 s"}}
OLD = {"kind": "T9", "params": {"how": "replay", "direction": "to_cell"}}


def test_a_host_that_was_away_does_not_make_up_for_what_it_missed(monkeypatch):
    assert fallen(PAUSE) == set()
    newest, servo = UrArm._newest, UrArm.servo
    missed = []

    def counted(self):
        found = newest(self)
        missed[:] = self._rtde.received[1:]
        return found

    def made_up_for(self, pose):
        for _ in missed:
            servo(self, pose)
        return servo(self, pose)

    monkeypatch.setattr(UrArm, "_newest", counted)
    monkeypatch.setattr(UrArm, "servo", made_up_for)
    assert "commands" in fallen(PAUSE)


def test_a_command_that_comes_again_is_not_followed(monkeypatch):
    assert fallen(OLD) == set()
    rewritten(monkeypatch, "sound = answered >= latest and ", "sound = ")
    assert "order" in fallen(OLD)


def test_commands_that_overtake_each_other_arrive_in_another_order():
    overtaken = {**OLD, "params": {"how": "reorder", "direction": "to_cell"}}
    begins = {"event": "phase: pick up", "offset": "+40 cycles"}
    trial = run_trial(RIG, 1, schedule([{"trigger": begins, **overtaken}]), longest=15.0)
    assert trial.violations == ()
    skipped = trial.trace["order"][trial.trace["t"] > trial.faults[0].active]
    assert {0.0, 2.0} <= set(skipped.tolist())
