import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.errors import RigError
from hil.cell.rig import LatencyLaw, parse

N = 20_000
MEAN, JITTER = 2e-3, 0.4e-3
LAWS = ("constant", "uniform", "normal", "gamma")
SIGMA = {"constant": 0.0, "uniform": JITTER / np.sqrt(3), "normal": JITTER, "gamma": JITTER}
"""Standard deviation of each law at JITTER, which is half the width of `uniform`."""


def law(name, mean=MEAN, jitter=JITTER):
    return LatencyLaw(law=name, mean=f"{mean!r} s", jitter=f"{jitter!r} s")


def draws(of, seed=1, count=N):
    return np.array(of.draws(np.random.default_rng(seed), count))


def standardised(of):
    seconds = draws(of) * 1e-9
    return (seconds - seconds.mean()) / seconds.std()


@given(st.sampled_from(LAWS), st.floats(1e-6, 1.0), st.floats(1e-6, 1.0), st.integers(0, 2**32))
def test_a_delay_is_never_negative_and_a_whole_number_of_ns(name, mean, jitter, seed):
    delays = law(name, mean, jitter).draws(np.random.default_rng(seed), 50)
    assert all(isinstance(delay, int) and delay >= 0 for delay in delays)


@given(st.sampled_from(LAWS), st.floats(1e-9, 1.0), st.floats(1e-9, 1.0), st.integers(0, 2**32))
def test_no_delay_is_shorter_than_the_least(name, mean, jitter, seed):
    delay = law(name, mean, jitter)
    assert min(delay.draws(np.random.default_rng(seed), 50)) >= delay.least


@pytest.mark.parametrize("name", LAWS)
def test_the_mean_is_the_rigs(name):
    bound = 4 * SIGMA[name] / np.sqrt(N) + 0.5e-9
    assert abs(draws(law(name)).mean() * 1e-9 - MEAN) <= bound


@pytest.mark.parametrize("name", LAWS)
def test_the_spread_is_the_rigs(name):
    # The error of a standard deviation is below sigma / sqrt(n) for all of these.
    bound = 4 * SIGMA[name] / np.sqrt(N)
    assert abs(draws(law(name)).std() * 1e-9 - SIGMA[name]) <= bound


def test_a_uniform_law_ends_at_its_half_width():
    delays = draws(law("uniform")) * 1e-9
    assert MEAN - JITTER <= delays.min() < MEAN - 0.99 * JITTER
    assert MEAN + 0.99 * JITTER < delays.max() <= MEAN + JITTER


def test_a_gamma_law_has_its_tail_late_and_a_normal_one_none():
    # Skewness of a gamma law is 2 jitter / mean; its error here is sqrt(6 / n).
    error = 4 * np.sqrt(6 / N)
    assert (standardised(law("gamma")) ** 3).mean() == pytest.approx(0.4, abs=2 * error)
    assert (standardised(law("normal")) ** 3).mean() == pytest.approx(0.0, abs=error)


@pytest.mark.parametrize("name", LAWS)
def test_one_delay_at_a_time_or_many_come_from_the_same_stream(name):
    one, many = np.random.default_rng(5), np.random.default_rng(5)
    assert [law(name).draw(one) for _ in range(20)] == law(name).draws(many, 20)


@pytest.mark.parametrize(
    ("section", "complaint"),
    [
        ("{mean: -1 ms}", "greater than or equal|must not be negative"),
        ("{law: gamma, mean: 1 ms}", "a gamma law needs a mean and a jitter"),
        ("{law: poisson, mean: 1 ms}", "'constant', 'uniform', 'normal' or 'gamma'"),
    ],
)
def test_a_law_that_cannot_be_drawn_from_is_refused_by_its_key(section, complaint):
    with pytest.raises(RigError, match=complaint) as refusal:
        parse(f"name: x\nlatency: {{can: {{to_cell: {section}}}}}")
    assert str(refusal.value).startswith("latency.can.to_cell")
