"""Laws of the statistics that experiments report."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hil.experiments.statistics import (
    improvement,
    interquartile,
    iqm,
    probability_of_improvement,
    spread,
    wilson,
)

numbers = st.floats(-1e6, 1e6)
samples = st.lists(numbers, min_size=1, max_size=30)


@pytest.fixture
def generator():
    return np.random.default_rng(1)


@given(st.integers(1, 500).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_wilsons_interval_holds_the_rate_and_stays_within_0_and_1(counts):
    successes, runs = counts
    low, high = wilson(successes, runs)
    assert 0.0 <= low <= successes / runs <= high <= 1.0
    mirrored = wilson(runs - successes, runs)
    assert mirrored == pytest.approx((1.0 - high, 1.0 - low))


@pytest.mark.parametrize(
    ("successes", "runs", "low", "high"), [(10, 10, 0.7225, 1.0), (81, 263, 0.2553, 0.3662)]
)
def test_wilsons_interval_is_that_of_the_books(successes, runs, low, high):
    """Newcombe 1998, table I, and the closed form n / (n + z^2) at full success."""
    assert wilson(successes, runs) == pytest.approx((low, high), abs=1e-4)


@given(samples)
def test_an_interquartile_mean_lies_among_the_values(values):
    assert min(values) - 1e-6 <= iqm(values) <= max(values) + 1e-6


@given(st.lists(numbers, min_size=4, max_size=30), numbers)
def test_one_outlier_does_not_move_an_interquartile_mean(values, outlier):
    above = [*sorted(values)[:-1], max(*values, abs(outlier))]
    assert iqm(above) == pytest.approx(iqm(values), abs=1e-6)


@given(samples, samples)
def test_either_method_improves_on_the_other_or_ties(ours, theirs):
    p = probability_of_improvement(ours, theirs)
    assert 0.0 <= p <= 1.0
    assert p + probability_of_improvement(theirs, ours) == pytest.approx(1.0)


def test_improvement_counts_pairs_and_ties_half():
    assert probability_of_improvement([1.0, 2.0], [1.0, 0.0]) == (0.5 + 1 + 1 + 1) / 4


def test_intervals_repeat_from_their_seed_and_hold_the_estimate(generator):
    values = generator.normal(size=40)
    first, second = (spread(values, np.random.default_rng(7)) for _ in range(2))
    assert first == second
    assert first.low < iqm(values) < first.high
    assert spread([3.0] * 5, generator) == (3.0, 3.0)


@pytest.mark.parametrize("statistic", [np.mean, interquartile])
def test_a_bootstrap_interval_covers_the_truth_about_as_often_as_it_says(generator, statistic):
    held = 0
    for _ in range(100):
        low, high = spread(generator.normal(size=30), generator, statistic)
        held += low <= 0.0 <= high
    assert 86 <= held <= 100  # 95 % less the percentile bootstrap's known shortfall


@settings(max_examples=10)
@given(st.lists(numbers, min_size=3, max_size=10))
def test_a_method_cannot_improve_on_itself(values):
    low, high = improvement(values, values, np.random.default_rng(1))
    assert low <= 0.5 <= high


@pytest.mark.parametrize("values", [[], [1.0, float("nan")], [float("inf")]])
def test_a_gap_in_the_figures_is_refused(values):
    with pytest.raises(ValueError, match="finite numbers"):
        iqm(values)
