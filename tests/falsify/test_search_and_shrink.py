import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.falsify.search import search
from hil.falsify.shrink import shrink
from hil.falsify.space import Axis, Choice, Part

SPACE = {
    "drop": {
        "p": Axis(0.0, 1.0, neutral=0.0),
        "cycles": Axis(1, 40, neutral=1, whole=True),
        "event": Choice(("contact", "search", "insert")),
    },
    "delay": {"mean": Axis(0.0, 0.05, neutral=0.0), "p": Axis(0.0, 1.0, neutral=0.0)},
}

drops = st.builds(
    lambda p, cycles, event: Part("drop", {"p": p, "cycles": cycles, "event": event}),
    st.floats(0.0, 1.0), st.integers(1, 40), st.sampled_from(["contact", "search", "insert"]),
)  # fmt: skip
delays = st.builds(
    lambda mean, p: Part("delay", {"mean": mean, "p": p}),
    st.floats(0.0, 0.05),
    st.floats(0.0, 1.0),
)
cases = st.lists(drops | delays, min_size=1, max_size=4).map(tuple)


def long_drop_in_search(case):
    """A planted bug: drops of 12 cycles and more while searching, however likely."""
    return any(
        part.kind == "drop" and part.values["cycles"] >= 12 and part.values["event"] == "search"
        for part in case
    )


def test_a_shrunk_case_is_one_part_at_the_edge_of_what_violates():
    noisy = (
        Part("delay", {"mean": 0.01, "p": 0.3}),
        Part("drop", {"p": 0.73, "cycles": 31, "event": "search"}),
        Part("drop", {"p": 0.11, "cycles": 3, "event": "insert"}),
    )
    found = shrink(noisy, SPACE, long_drop_in_search, budget=200)
    assert found.case == (Part("drop", {"p": 0.0, "cycles": 12, "event": "search"}),)
    assert found.irrelevant == {(0, "p")}


@given(cases.filter(long_drop_in_search), st.integers(1, 60))
def test_whatever_the_budget_the_result_violates_and_no_run_is_beyond_it(case, budget):
    asked = []

    def violates(case):
        asked.append(case)
        return long_drop_in_search(case)

    found = shrink(case, SPACE, violates, budget)
    assert long_drop_in_search(found.case)
    assert found.runs == len(asked) <= budget
    assert len(found.case) <= len(case)


@given(st.floats(0.05, 0.95), st.floats(0.0, 1.0))
def test_a_threshold_is_found_with_few_digits(threshold, share):
    start = threshold + share * (1.0 - threshold)
    case = (Part("delay", {"mean": 0.0, "p": start}),)
    found = shrink(case, SPACE, lambda case: case[0].values["p"] >= threshold, budget=100)
    value = found.case[0].values["p"]
    assert threshold <= value <= 1.0
    assert value - threshold <= 0.07  # a digit less is worth more than a nearer value


def test_a_case_that_violates_nothing_is_refused():
    with pytest.raises(ValueError, match="does not violate"):
        shrink((Part("delay", {"mean": 0.0, "p": 0.0}),), SPACE, lambda _: False, budget=5)


def robustness(case):
    """Worst in a corner: long drops with great p, in the search."""
    (part,) = case
    if part.kind != "drop":
        return 1.0
    far = 0.0 if part.values["event"] == "search" else 0.3
    return 0.12 + far - 0.004 * part.values["cycles"] * part.values["p"]


def test_the_search_stops_at_its_first_violation_and_needs_fewer_runs_than_chance():
    def runs(sampler):
        found = [
            search((SPACE,), robustness, budget=150, seed=seed, sampler=sampler)
            for seed in range(5)
        ]
        assert all(f.violated == (f.robustness < 0.0) for f in found)
        return sorted(f.runs for f in found)[2]

    assert runs("tpe") < runs("random")


def test_one_seed_is_one_search():
    told = []

    def tell(run, case, value):
        told.append((run, case, value))

    for _ in range(2):
        search((SPACE,), robustness, budget=20, seed=3, tell=tell)
    half = len(told) // 2
    assert told[:half] == told[half:]
