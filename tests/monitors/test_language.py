from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.monitors.errors import MonitorError
from hil.monitors.monitor import Monitor, offline

SCALES = {"f": 1.0, "speed": 0.01, "fault": 1.0}


def holds(text, **traces):
    rows = [dict(zip(traces, row, strict=True)) for row in zip(*traces.values(), strict=True)]
    return [verdict.holds for verdict in offline(text, SCALES, rows)]


def robustness(text, **traces):
    rows = [dict(zip(traces, row, strict=True)) for row in zip(*traces.values(), strict=True)]
    return [verdict.robustness for verdict in offline(text, SCALES, rows)]


def test_a_comparison_says_by_how_many_scales_it_holds():
    assert robustness("speed <= 0.05", speed=[0.0, 0.07]) == pytest.approx([5.0, -2.0])


def test_a_strict_comparison_is_false_on_its_bound():
    assert holds("f < 2", f=[2.0]) == [False]
    assert holds("f <= 2", f=[2.0]) == [True]
    assert holds("not f < 2", f=[2.0]) == [True]


def test_once_remembers_for_as_many_steps_as_its_window():
    assert holds("once[0:2] f > 0", f=[1, 0, 0, 0]) == [True, True, True, False]


def test_historically_asks_for_every_step_of_its_window():
    assert holds("historically[0:1] f > 0", f=[1, 1, 0, 1, 1]) == [True, True, False, False, True]


def test_a_window_may_begin_in_the_past():
    assert holds("once[1:2] f > 0", f=[1, 0, 0, 0]) == [False, True, True, False]


def test_without_a_window_all_steps_count():
    assert holds("historically f > 0", f=[1, 0, 1]) == [True, False, False]


def test_before_the_first_step_historically_is_true_and_once_false():
    assert robustness("historically[1:1] f > 0", f=[1.0]) == [inf]
    assert robustness("previously f > 0", f=[1.0]) == [-inf]


def test_implication_binds_weakest():
    assert holds("fault > 0 and f > 0 -> speed <= 0.01", fault=[1], f=[1], speed=[1]) == [False]
    assert holds("fault > 0 and f > 0 -> speed <= 0.01", fault=[1], f=[0], speed=[1]) == [True]


def test_a_standstill_is_owed_once_the_fault_has_lasted():
    text = "historically[0:2] (fault > 0.5) -> |speed| <= 0.01"
    moving = [1, 1, 1, -1, 0]
    assert holds(text, fault=[0, 1, 1, 1, 1], speed=moving) == [True, True, True, False, True]


@pytest.mark.parametrize("text", ["f <= 1", "not f <= 1", "f > 1", "historically f <= 1"])
def test_a_value_that_is_not_a_number_proves_nothing(text):
    assert holds(text, f=[nan]) == [False]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("f <=", "its end"),
        ("f <= 1 )", "column 8"),
        ("once[2:1] f > 0", "write [1:2]"),
        ("speeed <= 1", "did you mean 'speed'?"),
        ("f == 1", "column 3"),
        ("once[0.5:1] f > 0", "column 6"),
        ("", "its end"),
    ],
)
def test_a_formula_that_cannot_be_read_is_one_line(text, said):
    with pytest.raises(MonitorError) as error:
        Monitor(text, SCALES)
    assert said in str(error.value)
    assert "\n" not in str(error.value)


@given(st.lists(st.floats(-5, 5), min_size=1, max_size=40), st.integers(0, 6), st.integers(0, 6))
def test_a_window_is_the_extreme_of_the_steps_it_names(values, near, more):
    far = near + more
    shown = robustness(f"once[{near}:{far}] f >= 0", f=values)
    for i, value in enumerate(shown):
        seen = [values[j] for j in range(max(0, i - far), i - near + 1)]
        assert value == (max(seen) if seen else -inf)


@given(st.lists(st.tuples(st.floats(-5, 5), st.floats(0, 1)), min_size=1, max_size=30))
def test_negation_turns_the_verdict_round(rows):
    traces = {"f": [a for a, _ in rows], "fault": [b for _, b in rows]}
    text = "(once[0:3] fault > 0.5) -> historically[1:2] (f <= 2 or previously f > 4)"
    plain, negated = holds(text, **traces), holds(f"not ({text})", **traces)
    assert [not one for one in plain] == negated


def test_a_missing_signal_is_an_error_and_not_a_zero():
    with pytest.raises(KeyError):
        Monitor("f <= 1", SCALES).step({"speed": 0.0})
