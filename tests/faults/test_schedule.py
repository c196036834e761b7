"""Schedules: what is written is what is meant, and every mistake is one line."""

import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from hil.cell.errors import FaultError
from hil.cell.faults.catalogue import CATALOGUE
from hil.cell.faults.event import Event, Kind
from hil.cell.faults.parse import fault, load, parse
from hil.cell.faults.schedule import Fault, Schedule
from hil.cell.faults.span import Span
from hil.cell.faults.trigger import Trigger, never

FILE = """
faults:
  - kind: sensor.stuck
    trigger: {event: contact, offset: +3 cycles}
    cycles: 8
  - kind: T1
    trigger: {event: "phase: insert"}
    params: {mean: 6 ms, law: normal}
"""


def test_a_file_becomes_faults_in_si_with_every_default_filled_in():
    stuck, latency = parse(FILE).faults
    assert (stuck.kind, stuck.duration) == ("S3", Span(cycles=8))
    assert stuck.trigger == Trigger(event=Event(Kind.CONTACT), offset=Span(cycles=3))
    assert latency.number("mean") == 6e-3
    assert latency.word("law") == "normal"
    assert latency.number("jitter") == 2e-3


@pytest.mark.parametrize(
    ("entry", "complaint"),
    [
        ("{kind: C77}", "no fault 'C77'; did you mean 'C7'?"),
        ("{kind: C1, triger: {}}", "did you mean 'trigger'?"),
        ("{kind: C1, trigger: {att: 2 s}}", "did you mean 'at'?"),
        ("{kind: C1, trigger: {at: 2 m}}", "'2 m' is not a time such as '3 cycles' or '0.2 s'"),
        ("{kind: C1, trigger: {at: -2 s}}", "'-2 s' is not a time"),
        ("{kind: C1, trigger: {at: .nan}}", "nan is not a time"),
        ("{kind: C1, trigger: {at: 2}}", "2 has no unit of time; write 'cycle: 2'"),
        ("{kind: C1, trigger: {cycle: -1}}", "-1 is not a whole number >= 0"),
        ("{kind: C1, trigger: {at: 1 s, cycle: 3}}", "at and cycle are two beginnings"),
        ("{kind: C1, trigger: {event: contakt}}", "did you mean 'contact'?"),
        ("{kind: C1, trigger: {event: 'phase: inzert'}}", "did you mean 'insert'?"),
        ("{kind: C1, trigger: {event: 'state: protected'}}", "there are: normal"),
        ("{kind: C1, trigger: {event: 'force > 5 s'}}", "'5 s' is not a quantity in N"),
        ("{kind: C1, trigger: {event: 'force > -5 N'}}", "-5 N is below 0 N"),
        ("{kind: C1, trigger: {event: 'force: 5 N'}}", "not how an event is written"),
        ("{kind: C1, trigger: {event: 'episode >= many'}}", "write a whole number"),
        ("{kind: C1, trigger: {prob: 0}}", "0 is not a chance in (0, 1]"),
        ("{kind: C1, trigger: {prob: .nan}}", "is not a chance"),
        ("{kind: C1, trigger: {every: 0 s}}", "'0 s' is no time at all"),
        ("{kind: C1, cycles: 3, duration: 1 s}", "two lengths; take one"),
        ("{kind: C1, cycles: 0}", "0 is no time at all"),
        ("{kind: C1, cycles: 1 s}", "write it as duration"),
        ("{kind: R1, cycles: 3}", "R1 robot.protective_stop happens in one moment"),
        ("{kind: R1, params: {x: 1}}", "R1 robot.protective_stop has no parameters"),
        ("{kind: T6, trigger: {at: 1 s}}", "exists at power-up only"),
        ("{kind: C1, params: {sharre: 1}}", "did you mean 'share'?"),
        ("{kind: C1, params: {share: 2}}", "2 is out of range, allowed is 0 .. 1"),
        ("{kind: C1, params: {share: .nan}}", "nan is not finite"),
        ("{kind: C1, params: {share: lots}}", "'lots' is not a number"),
        ("{kind: C2, params: {mean: 3}}", "3 has no unit; write '3 s'"),
        ("{kind: C2, params: {mean: 3 N}}", "'3 N' is not a quantity in s"),
        ("{kind: T5, params: {how: rest}}", "did you mean 'rst'?"),
        ("{kind: T9, params: {depth: 1.5}}", "whole numbers 1 .. 100"),
        ("{trigger: {at: 1 s}}", "None is not an id"),
        ("7", "7 is no fault"),
    ],
)
def test_a_mistake_is_one_line_that_says_what_was_found_and_what_is_allowed(entry, complaint):
    with pytest.raises(FaultError) as error:
        parse(f"faults: [{entry}]")
    assert complaint in str(error.value)
    assert str(error.value).startswith("faults[0]")
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "a list of at least one fault"),
        ("faults: []", "a list of at least one fault"),
        ("fault: [C1]", "did you mean 'faults'?"),
        ("{faults: [C1], pick: 2}", "not a whole number in 1 .. 1"),
        ("[", "not YAML"),
    ],
)
def test_a_file_without_faults_is_refused(text, complaint):
    with pytest.raises(FaultError, match=r".") as error:
        parse(text)
    assert complaint in str(error.value)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(FaultError, match=r"none\.yaml: cannot be read"):
        load(tmp_path / "none.yaml")


spans = st.integers(1, 10**6).map(lambda n: Span(n, 0)) | st.integers(1, 10**12).map(
    lambda n: Span(0, n)
)
events = st.integers(0, 100).map(lambda n: Event(Kind.FORCE, "", float(n))) | st.sampled_from(
    [Event(Kind.CONTACT), Event(Kind.PHASE, "insert"), Event(Kind.CLEARED, "C1")]
)
triggers = st.one_of(
    st.builds(Trigger, at=st.integers(0, 10**12), offset=spans),
    st.builds(Trigger, cycle=st.integers(0, 10**6), every=spans),
    st.builds(Trigger, event=events, offset=spans),
    st.builds(Trigger, prob=st.integers(1, 1000).map(lambda n: n / 1000)),
)


@st.composite
def faults(draw):
    row = draw(st.sampled_from(CATALOGUE))
    values = {}
    for parameter in row.parameters:
        if parameter.choices:
            values[parameter.name] = draw(st.sampled_from(parameter.choices))
        elif parameter.whole:
            values[parameter.name] = draw(st.integers(int(parameter.low), int(parameter.high)))
        else:
            values[parameter.name] = draw(
                st.floats(parameter.low, parameter.high, allow_subnormal=False, width=32)
                if parameter.low in (0.0, 1.0) and parameter.high in (1.0, 1000.0)
                else st.just(parameter.default)
            )
    begins = Trigger() if row.start else draw(triggers)
    return Fault(row.id, values, begins, draw(spans | st.none()) if row.lasting else None)


@settings(max_examples=40)
@given(st.lists(faults(), min_size=1, max_size=3))
def test_a_schedule_that_is_written_and_read_again_is_the_same(found):
    schedule = Schedule(tuple(found))
    assert parse(yaml.safe_dump(schedule.written())) == schedule


def test_a_random_subset_is_the_seeds_choice_in_the_files_order():
    schedule = Schedule(tuple(fault("f", kind) for kind in ("C1", "C2", "C3", "C4")), pick=2)
    drawn = [schedule.drawn(np.random.default_rng(seed)).faults for seed in range(40)]
    assert all(len(kinds) == 2 and kinds[0].kind < kinds[1].kind for kinds in drawn)
    assert len({tuple(one.kind for one in kinds) for kinds in drawn}) == 6


def test_a_trigger_that_waits_for_more_episodes_than_there_are_can_never_fire():
    waits = fault("f", {"kind": "C1", "trigger": "episode >= 3"}).trigger
    assert "the run has 1 episode, it waits for episode >= 3" in never(waits, 8_000_000, 1)
    assert never(waits, 8_000_000, 3) == ""
