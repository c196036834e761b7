"""Triggers, stages and dice of one run's faults."""

import pytest

from hil.cell.faults.injector import Injector
from hil.cell.faults.log import Stage, idle
from hil.cell.faults.parse import schedule
from hil.cell.faults.situation import Situation

PERIOD = 8_000_000


def injector(schedule, seed, period):
    return Injector(schedule.numbered(seed), seed, period)


def situation(cycle, **about):
    return Situation(cycle * PERIOD, cycle, **about)


def begun(trigger, situations, **fault):
    """Cycles in which a fault with this trigger begins."""
    found = injector(schedule([{"kind": "C1", "trigger": trigger, **fault}]), 1, PERIOD)
    cycles = []
    for now in situations:
        before = found.of("C1")
        found.look(now)
        cycles += [now.cycle for one in found.of("C1") if one not in before]
    return cycles


def cycles(count, **about):
    return [situation(cycle, **about) for cycle in range(count)]


@pytest.mark.parametrize(
    ("trigger", "expected"),
    [
        ({}, [0]),
        ({"at": "40 ms"}, [5]),
        ({"at": "41 ms"}, [6]),
        ({"cycle": 7}, [7]),
        ({"cycle": 7, "offset": "+2 cycles"}, [9]),
        ({"cycle": 7, "offset": "+16 ms"}, [9]),
        ({"prob": 1}, [0]),
    ],
)
def test_a_trigger_fires_once_at_its_cycle(trigger, expected):
    assert begun(trigger, cycles(20)) == expected


def test_a_fault_comes_back_every_so_often_once_its_last_time_is_over():
    assert begun({"cycle": 2, "every": "5 cycles"}, cycles(14), cycles=3) == [2, 7, 12]


@pytest.mark.parametrize(
    ("event", "about"),
    [
        ("contact", {"contact": True}),
        ("phase: insert", {"phase": "insert"}),
        ("phase: insert", {"phase": "draw out"}),
        ("phase: tare", {"phase": "tare"}),
        ("force > 5 N", {"force": 5.1}),
        ("episode >= 3", {"episode": 3}),
        ("state: protective_stop", {"safety": "protective_stop"}),
    ],
)
def test_an_event_fires_in_the_first_cycle_in_which_it_holds(event, about):
    quiet, loud = cycles(5, force=5.0, episode=2), situation(5, **about)
    assert begun({"event": event}, [*quiet, loud, situation(6)]) == [5]
    assert begun({"event": event, "offset": 2}, [*quiet, loud, *cycles(9)[6:]]) == [7]


def test_chance_is_the_seeds():
    schedules = schedule([{"kind": "C1", "trigger": {"prob": "0.1/cycle"}}])

    def first(seed):
        found = injector(schedules, seed, PERIOD)
        return next(n for n in range(1000) if (found.look(situation(n)), found.of("C1"))[1])

    assert [first(seed) for seed in range(30)] == [first(seed) for seed in range(30)]
    assert len({first(seed) for seed in range(30)}) > 5


def test_a_fault_is_armed_then_active_where_it_is_felt_then_cleared():
    found = injector(schedule([{"kind": "C1", "trigger": {"cycle": 2}, "cycles": 3}]), 1, PERIOD)
    for now in cycles(7):
        found.look(now)
        for one in found.of("C1"):
            if now.cycle >= 3:
                one.felt(now.t + 1, "a frame")
    stages = [(event.stage, event.t) for event in found.events]
    assert stages == [
        (Stage.ARMED, 0),
        (Stage.ACTIVE, 3 * PERIOD + 1),
        (Stage.CLEARED, 5 * PERIOD),
    ]
    assert idle(found.events) == ()


def test_a_fault_that_nobody_felt_is_idle():
    found = injector(schedule([{"kind": "C1", "cycles": 3}, "S3"]), 1, PERIOD)
    for now in cycles(7):
        found.look(now)
    assert idle(found.events) == ((0, "C1"), (1, "S3"))


def test_one_fault_can_wait_for_another_to_be_over_or_overlap_it():
    found = injector(
        schedule(
            [
                {"kind": "C1", "trigger": {"cycle": 2}, "cycles": 3},
                {"kind": "S3", "trigger": {"event": "cleared: can.drop", "offset": 1}},
                {"kind": "T1", "trigger": {"event": "active: C1"}},
            ]
        ),
        1,
        PERIOD,
    )
    since = {}
    for now in cycles(10):
        found.look(now)
        for kind in ("C1", "S3", "T1"):
            for one in found.of(kind):
                one.felt(now.t)
                since.setdefault(kind, now.cycle)
    assert since == {"C1": 2, "T1": 3, "S3": 6}


def test_dice_depend_on_seed_fault_and_time_alone():
    def draw(seed, t, kind="C1"):
        found = injector(schedule([kind]), seed, PERIOD)
        found.look(situation(0))
        (one,) = found.of(kind)
        return one.draws(t).random()

    assert draw(1, 5) == draw(1, 5)
    assert len({draw(1, 5), draw(2, 5), draw(1, 6), draw(1, 5, "C2")}) == 4
