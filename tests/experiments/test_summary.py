import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.experiments.insertion import Row, summary


def row(seed, seated, steps=10, kind="inserted", over=0):
    return Row(seed, kind, "", steps, 5.0, 12.0, seated, over)


def series(good, bad):
    return [row(n, n < good, kind="inserted" if n < good else "limit") for n in range(good + bad)]


def test_eight_of_ten_have_the_wilson_interval_of_the_textbook():
    found = summary(series(8, 2))
    assert (found.runs, found.inserted, found.success) == (10, 8, 0.8)
    # z = 1.96: (p + z²/2n ± z sqrt(p(1-p)/n + z²/4n²)) / (1 + z²/n)
    assert found.success_low == pytest.approx(0.4902, abs=5e-5)
    assert found.success_high == pytest.approx(0.9433, abs=5e-5)


def test_none_of_ten_still_allows_a_quarter():
    found = summary(series(0, 10))
    assert (found.success, found.success_low) == (0.0, 0.0)
    assert found.success_high == pytest.approx(0.2775, abs=5e-5)
    assert found.steps_median == 0.0


@given(st.integers(0, 60), st.integers(0, 60))
def test_the_interval_holds_the_share_and_lies_within_0_and_1(good, bad):
    if good + bad == 0:
        return
    found = summary(series(good, bad))
    assert 0.0 <= found.success_low <= found.success <= found.success_high <= 1.0


@given(st.integers(1, 20), st.integers(1, 20))
def test_more_runs_of_the_same_share_narrow_the_interval(good, bad):
    few, many = summary(series(good, bad)), summary(series(4 * good, 4 * bad))
    assert many.success_high - many.success_low < few.success_high - few.success_low


def test_steps_are_those_of_the_successful_runs():
    rows = [row(1, True, 10), row(2, True, 30), row(3, True, 20), row(4, False, 500, "limit")]
    assert summary(rows).steps_median == 20


def test_a_run_that_says_inserted_without_a_seated_part_is_no_success():
    found = summary([row(1, True), row(2, False)])
    assert (found.inserted, found.success) == (1, 0.5)
    assert found.endings == {"inserted": 2}


def test_endings_are_counted_by_kind_and_the_worst_excess_is_kept():
    rows = [row(1, True), row(2, False, kind="danger", over=2), row(3, False, kind="danger")]
    found = summary(rows)
    assert found.endings == {"inserted": 1, "danger": 2}
    assert found.worst_over == 2


def test_a_series_of_no_runs_has_no_summary():
    with pytest.raises(ValueError, match="not less than 1"):
        summary([])
