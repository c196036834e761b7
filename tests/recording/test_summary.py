import csv
import io
from dataclasses import replace

import pytest

from hil.recording import csv_file
from hil.recording.series import truth
from hil.recording.summary import Span, summarise, timeline


def test_a_summary_names_phases_with_their_times(run):
    assert [span.name for span in summarise(run).phases] == [
        "pick up",
        "contact",
        "search",
        "retract",
    ]
    assert summarise(run).phases[1] == Span("contact", pytest.approx(0.088), pytest.approx(0.168))


def test_the_slot_is_found_when_the_tip_first_enters(run):
    assert summarise(run).slot_found == pytest.approx(41 * 8e-3)


def test_forces_depth_trips_and_misses_are_counted(run):
    summary = summarise(run)
    assert summary.f_z == (0.0, 5.0)
    assert summary.depth == pytest.approx(1.9e-3)
    assert (summary.guard_trips, summary.misses, summary.outcome) == (1, 2, "inserted")
    assert summary.counts["/wrench/true"] == 60


def test_the_timeline_is_in_order_of_time(run):
    times = [entry.t for entry in timeline(summarise(run))]
    assert times == sorted(times)
    assert len(times) == 4 + 3 + 2


def test_an_empty_recording_has_a_summary_that_claims_nothing(run):
    summary = summarise(replace(run, messages=()))
    assert summary.duration == 0.0
    assert (summary.slot_found, summary.depth, summary.f_z) == (None, None, None)


def test_true_wrenches_lie_one_millisecond_apart_and_end_with_their_period(run):
    t = truth(run).t_wrench
    assert t[:8] == pytest.approx([1e-3 * i for i in range(1, 9)], abs=1e-12)


def test_the_table_has_a_row_a_period_with_truth_beside_control(run):
    text = io.StringIO()
    assert csv_file.write(run, text) == 60
    rows = list(csv.DictReader(io.StringIO(text.getvalue())))
    assert rows[59]["contact"] == "slot"
    assert float(rows[59]["depth"]) == pytest.approx(1.9e-3)
    assert float(rows[30]["fz"]) == 5.0


def test_the_table_leaves_the_truth_empty_where_there_is_none(run):
    near = tuple(m for m in run.messages if m.topic == "/ctrl")
    text = io.StringIO()
    csv_file.write(replace(run, messages=near), text)
    rows = list(csv.DictReader(io.StringIO(text.getvalue())))
    assert {row["contact"] for row in rows} == {""}
