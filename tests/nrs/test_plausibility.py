"""Stuck and blank signals: found to the sample, never seen in noise."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.errors import BlankSignalError, FlatSignalError
from drivers.nrs.plausibility import OFF, TYPICAL, Plausibility, Plausible

STUCK = (1.5, -3.0, -9.81, 0.05, -0.1, 0.02)
ZERO = (0.0,) * 6
runs = st.lists(
    st.tuples(st.sampled_from([STUCK, ZERO, (0.0, *STUCK[1:])]), st.integers(1, 30)), max_size=8
)


def refuses(plausibility):
    try:
        plausibility.check()
    except FlatSignalError:
        return True
    return False


@given(runs, st.integers(2, 20), st.integers(2, 20))
def test_a_signal_is_refused_exactly_while_a_run_is_too_long(runs, flat, blank):
    watched = Plausibility(Plausible(flat, blank))
    last, length = None, 0
    for wrench, count in runs:
        for _ in range(count):
            length = length + 1 if wrench == last else 1
            last = wrench
            watched.watch(wrench)
            blanked = wrench == ZERO and blank <= length
            assert refuses(watched) == (length >= flat or blanked)


@given(st.integers(2, 50))
def test_a_run_that_ended_before_the_next_check_is_told_once(flat):
    watched = Plausibility(Plausible(flat, 0))
    for _ in range(flat):
        watched.watch(STUCK)
    watched.watch(ZERO)
    assert refuses(watched)
    assert not refuses(watched)


def test_a_run_that_goes_on_is_told_at_every_check():
    watched = Plausibility(TYPICAL)
    for _ in range(TYPICAL.flat):
        watched.watch(STUCK)
    assert all(refuses(watched) for _ in range(3))


@pytest.mark.parametrize("sigma", [0.3, 1.0, 3.3])
def test_noise_of_a_third_of_a_count_is_never_flat(sigma):
    rng = np.random.default_rng(1)
    counts = np.rint(rng.normal(0.0, sigma, (60_000, 6)) + 700.0)
    watched = Plausibility(TYPICAL)
    for row in counts.tolist():
        watched.watch(tuple(row))
        watched.check()


def test_noise_of_a_typical_sensor_around_zero_is_never_blank():
    rng = np.random.default_rng(2)
    watched = Plausibility(TYPICAL)
    for row in np.rint(rng.normal(0.0, [3.3] * 3 + [2.6] * 3, (60_000, 6))).tolist():
        watched.watch(tuple(row))
        watched.check()


def test_zeros_are_named_blank_and_a_stuck_value_is_shown():
    watched = Plausibility(TYPICAL)
    for _ in range(TYPICAL.blank):
        watched.watch(ZERO)
    with pytest.raises(BlankSignalError, match="zero on every axis"):
        watched.check()
    watched.restart()
    for _ in range(TYPICAL.flat):
        watched.watch(STUCK)
    with pytest.raises(FlatSignalError, match=r"stuck at \(1\.5"):
        watched.check()


def test_checks_that_are_off_believe_everything():
    watched = Plausibility(OFF)
    for _ in range(1000):
        watched.watch(ZERO)
        watched.check()


@pytest.mark.parametrize("limits", [(1, 5), (20, 1), (-1, 5), (20, -1)])
def test_limits_that_mean_nothing_are_refused(limits):
    with pytest.raises(ValueError, match="runs are"):
        Plausibility(Plausible(*limits))
