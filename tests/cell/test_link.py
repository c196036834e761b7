from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.link import Link
from hil.cell.rig import LatencyLaw

LAWS = {
    "none": LatencyLaw(),
    "constant": LatencyLaw(mean="0.3 ms"),
    "uniform": LatencyLaw(law="uniform", mean="1 ms", jitter="1 ms"),
    "normal": LatencyLaw(law="normal", mean="1 ms", jitter="2 ms"),
    "gamma": LatencyLaw(law="gamma", mean="1 ms", jitter="3 ms"),
}
END = 10**15

laws = st.sampled_from(sorted(LAWS))
seeds = st.integers(0, 2**32)
times = st.lists(st.integers(0, 10**9), min_size=1, max_size=300).map(sorted)


def loaded(law, seed, sent):
    link = Link(LAWS[law], np.random.default_rng(seed))
    link.extend((t, number) for number, t in enumerate(sent))
    return link


@given(laws, seeds, times)
def test_everything_comes_out_once_and_in_order(law, seed, sent):
    arrived = loaded(law, seed, sent).due(END)
    assert [number for _, number in arrived] == list(range(len(sent)))
    assert all(before <= after for (before, _), (after, _) in pairwise(arrived))


@given(laws, seeds, times)
def test_nothing_arrives_before_it_was_sent(law, seed, sent):
    arrived = loaded(law, seed, sent).due(END)
    assert all(arrival >= t for (arrival, _), t in zip(arrived, sent, strict=True))


@given(laws, seeds, times, st.lists(st.integers(0, 2 * 10**9), max_size=20).map(sorted))
def test_when_it_is_asked_for_changes_neither_order_nor_arrival(law, seed, sent, asked):
    at_once = loaded(law, seed, sent).due(END)
    link, piecewise = loaded(law, seed, sent), []
    for t in asked:
        due = link.due(t)
        assert all(arrival <= t for arrival, _ in due)
        piecewise += due
        assert len(piecewise) == sum(arrival <= t for arrival, _ in at_once)
    assert piecewise + link.due(END) == at_once


@given(laws, seeds, times)
def test_one_seed_gives_the_same_arrivals(law, seed, sent):
    assert loaded(law, seed, sent).due(END) == loaded(law, seed, sent).due(END)


@given(seeds, times)
def test_a_constant_link_delays_everything_alike(seed, sent):
    arrivals = [arrival for arrival, _ in loaded("constant", seed, sent).due(END)]
    assert arrivals == [t + 300_000 for t in sent]


def test_an_instant_link_delivers_at_the_moment_of_sending():
    assert loaded("none", 1, [5, 5, 9]).due(9) == [(5, 0), (5, 1), (9, 2)]


def test_a_message_that_travels_fast_waits_for_the_slow_one_before_it():
    sent = list(range(0, 10**8, 10**5))  # ten in each mean delay
    arrivals = np.array([arrival for arrival, _ in loaded("gamma", 3, sent).due(END)])
    assert (np.diff(arrivals) == 0).any()


@pytest.mark.parametrize("law", sorted(LAWS))
def test_messages_far_apart_are_delayed_as_the_law_says(law):
    sent = [k * 10**9 for k in range(600)]  # more than one block of draws
    delays = [arrival - k * 10**9 for arrival, k in loaded(law, 4, sent).due(END)]
    assert delays == LAWS[law].draws(np.random.default_rng(4), 600)
