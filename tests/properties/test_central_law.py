"""For every sequence of learner actions and every single fault, F1 to F3 hold, and the run ends.

`make test` tries a few, `pytest -m campaign tests/properties` with a profile many.
"""

import re

import pytest
from hypothesis import HealthCheck, Phase, example, given, settings
from hypothesis import strategies as st

from controller.action import Action
from controller.guard import Guard
from drivers.nrs.assembler import Assembler
from drivers.protocol.nrs_sample import decode_pair
from drivers.ur.arm import UrArm
from drivers.ur.program import ServoProgram
from hil.cell.faults.catalogue import CATALOGUE
from hil.cell.faults.event import event
from hil.cell.faults.row import Phase as Where
from hil.cell.faults.row import Place
from hil.cell.faults.schedule import Fault, Schedule
from hil.cell.faults.span import Span
from hil.cell.faults.trigger import Trigger
from hil.trial.trial import run_trial
from hil.trial.verdict import Verdict
from hil_fixtures import strategies as hs
from hil_fixtures.testbed import shipped
from hil_fixtures.visits import MOVING, SAFETY_STOP, STOPPING, Visits

RIG = shipped("ffc_short")
LONGEST = 30.0
"""Bench seconds; the longest sequence of actions takes 20."""
UNSAFE = (Verdict.FAILED, Verdict.HANG, Verdict.CRASH)
ONE = hs.Actions([Action.PLUS_X])
KINDS = [row.id for row in CATALOGUE if row.place is not Place.AGENTS]
CASES = st.tuples(hs.faults(KINDS), hs.learner_actions(max_size=12))


def holds(fault, actions, visits):
    """One run under one fault; the verdict counts, and where it has been."""
    trial = run_trial(RIG, 1, Schedule((fault,)), policy=actions, longest=LONGEST)
    visits.take(trial.trace)
    assert trial.verdict not in UNSAFE, f"{trial.verdict}: {trial.reason}"


def begun(kind, params=None, at="phase: pick up"):
    """A fault that begins soon after an event, and lasts."""
    return Fault(kind, params or {}, Trigger(event=event("event", at), offset=Span(cycles=5)), None)


def tried(examples=None):
    """The law over so many cases, or as many as the profile says; where it has been."""
    visits = Visits()
    some = {} if examples is None else {"max_examples": examples, "derandomize": True}

    @settings(
        deadline=None, database=None, phases=[Phase.explicit, Phase.generate],
        suppress_health_check=list(HealthCheck), **some,
    )  # fmt: skip
    @example((begun("R1", at="contact"), ONE))
    @example((begun("C7"), ONE))
    @example((begun("C7", at="contact"), ONE))
    @given(CASES)
    def law(case):
        holds(*case, visits)

    law()
    return visits


def test_no_actions_under_any_single_fault_break_f1_to_f3():
    visits = tried(examples=4)
    visits.require((Where.FREE, MOVING), (Where.FREE, STOPPING), (Where.CONTACT, SAFETY_STOP))


@pytest.mark.campaign
@pytest.mark.timeout(0)
def test_no_actions_under_any_single_fault_break_f1_to_f3_at_length():
    moving = [(phase, MOVING) for phase in Where]
    stopping = [(phase, STOPPING) for phase in (Where.FREE, Where.APPROACH, Where.CONTACT)]
    tried().require(*moving, *stopping)


# The same law with bugs planted in the near side.


def guard_with_ten_times_its_bound(patch):
    sound = Guard.__init__
    patch.setattr(
        Guard, "__init__", lambda self, limits, period: sound(self, limits.relaxed(10.0), period)
    )


def driver_that_fills_half_a_wrench_with_the_last_other_half(patch):
    """Pairs the last of each frame, whatever their counters."""

    def join(self, is_force, octets, t):
        kept = self.__dict__.setdefault("kept", {})
        kept[is_force] = octets
        if len(kept) < 2:
            return None
        mask = (1 << 51) - 1  # the counter comes after the values
        head, tail = (int.from_bytes(one, "little") for one in (kept[True], octets))
        force = ((head & mask) | (tail & ~mask)).to_bytes(8, "little")
        return decode_pair(force, kept[False][:7] + octets[7:])

    patch.setattr(Assembler, "_join", join)


def program_that_minds_no_age(patch):
    sound = ServoProgram.text

    def text(self, rate):
        return re.sub(r"(silent >=|silent <=|answered >) \d+", r"\1 1000000", sound(self, rate))

    patch.setattr(ServoProgram, "text", text)
    patch.setattr(UrArm, "_mind_echo", lambda *_: None)  # or the host stops the program itself


OLD = {"mean": 0.3, "jitter": 0.0, "law": "constant", "direction": "to_cell"}
BUGS = [
    (guard_with_ten_times_its_bound, begun("S1", {"force": 4.0, "axis": "fx"})),
    (driver_that_fills_half_a_wrench_with_the_last_other_half, begun("C9")),
    (program_that_minds_no_age, begun("T1", OLD)),
]


@pytest.mark.parametrize(("plant", "fault"), BUGS)
def test_a_planted_bug_breaks_the_law(monkeypatch, plant, fault):
    holds(fault, ONE, Visits())
    plant(monkeypatch)
    with pytest.raises(AssertionError):
        holds(fault, ONE, Visits())
