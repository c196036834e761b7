"""The wall-paced schedule under a clock that the test moves by hand."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.clock import ARREARS, BIN, BINS, Schedule

PERIOD = 8_000_000
START = 123_456_789


class HandClock:
    def __init__(self):
        self.t = START

    def __call__(self):
        return self.t


def run(lates):
    """A schedule whose period k begins `lates[k]` ns after it was due, and its clock."""
    clock = HandClock()
    schedule = Schedule(PERIOD, clock)
    for k, late in enumerate(lates):
        clock.t = START + (k + 1) * PERIOD + late
        schedule.begin()
    return schedule, clock


lates = st.lists(
    st.one_of(st.integers(0, 3 * PERIOD), st.integers(0, 3 * BIN * BINS)), min_size=1, max_size=200
)


@given(lates)
def test_a_late_period_never_moves_the_ones_after_it(lates):
    schedule, clock = run(lates)
    assert schedule.remaining() == START + (len(lates) + 1) * PERIOD - clock.t


@given(st.integers(ARREARS + 1, 10**6 * ARREARS))
def test_what_a_sleeping_machine_missed_is_not_made_up_for_but_told(late):
    schedule, _ = run([0, late])
    assert schedule.remaining() == PERIOD
    assert schedule.lateness().forgone == late


@given(lates)
def test_what_can_be_made_up_for_is_not_forgone(lates):
    assert run(lates)[0].lateness().forgone == 0


@given(lates)
def test_every_period_is_counted_and_each_later_than_a_period_is_a_miss(lates):
    lateness = run(lates)[0].lateness()
    assert lateness.periods == len(lates)
    assert lateness.missed == sum(late > PERIOD for late in lates)
    assert lateness.max == max(lates)


@given(lates)
def test_no_percentile_understates_its_share_of_the_periods(lates):
    lateness = run(lates)[0].lateness()
    for share, bound in ((0.5, lateness.p50), (0.99, lateness.p99)):
        assert sum(late <= bound for late in lates) >= share * len(lates)
    assert lateness.p50 <= lateness.p99 <= lateness.max


@given(st.lists(st.integers(0, BIN * BINS - 1), min_size=1, max_size=200))
def test_a_percentile_is_exact_to_one_bin(lates):
    lateness = run(lates)[0].lateness()
    ranked = sorted(lates)
    median = ranked[(len(lates) + 1) // 2 - 1]
    assert median <= lateness.p50 <= median + BIN


def test_a_period_that_begins_early_is_not_late():
    assert run([-PERIOD // 2])[0].lateness() == (1, 0, 0, 0, 0, 0)


def test_nothing_is_late_before_the_first_period():
    schedule, _ = run([])
    assert schedule.lateness() == (0, 0, 0, 0, 0, 0)
    assert schedule.remaining() == PERIOD


@pytest.mark.parametrize("periods", [1, 1000])
def test_a_schedule_that_is_kept_is_never_late(periods):
    assert run([0] * periods)[0].lateness() == (periods, 0, 0, 0, 0, 0)
