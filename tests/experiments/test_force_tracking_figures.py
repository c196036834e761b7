"""Figures of merit on hand-made traces whose answer is known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.experiments.force_tracking.figures import figures, settling
from hil.experiments.force_tracking.table import ratio, series, spread_of
from hil.experiments.force_tracking.trace import Trace
from hil.experiments.force_tracking.variant import Variant

FORCE = 10.0


def traced(push, touch=100, slide=3300):
    return Trace(np.asarray(push, float), touch, slide, np.zeros((1, 2)), 8)


@pytest.fixture
def ideal():
    """Free for 100 ms, then f_d at once and for 8 s."""
    push = np.full(8100, FORCE)
    push[:100] = 0.0
    return push


def test_a_force_that_is_right_at_once_has_no_error(ideal):
    found = figures(traced(ideal), FORCE, completed=True)
    assert found == (0.0, 0.0, 0.0, 0.0, FORCE, False)


def test_overshoot_is_a_share_of_the_wanted_force(ideal):
    ideal[150] = 12.0
    assert figures(traced(ideal), FORCE, completed=True).overshoot == pytest.approx(0.2)


def test_an_overshoot_while_sliding_is_a_peak_and_no_overshoot(ideal):
    ideal[5000] = 13.0
    found = figures(traced(ideal), FORCE, completed=True)
    assert (found.overshoot, found.peak) == (0.0, 13.0)


def test_settling_is_when_the_smoothed_force_enters_its_band_for_good(ideal):
    ideal[100:600] = 5.0
    # The 24 ms mean is within 5 % once at most 2 of its samples are the old ones.
    found = figures(traced(ideal), FORCE, completed=True).settling
    assert found == pytest.approx(0.522, abs=2e-3)


def test_tracking_error_is_of_the_slide_after_its_onset(ideal):
    ideal[3300:3800] = 0.3
    ideal[3800:] = 9.5
    assert figures(traced(ideal), FORCE, completed=True).rms_tracking == pytest.approx(0.5)


def test_a_limit_cycle_is_unstable(ideal):
    ideal[100:] += 2.0 * np.sin(np.arange(8000) / 10.0)
    assert figures(traced(ideal), FORCE, completed=True).unstable


def test_a_bouncing_contact_is_unstable(ideal):
    ideal[1500::20] = 0.0
    assert figures(traced(ideal), FORCE, completed=True).unstable


def test_a_stopped_run_is_unstable_whatever_it_did_before(ideal):
    found = figures(traced(ideal[:500], slide=None), FORCE, completed=False)
    assert found.unstable
    assert (found.rms_static, found.rms_tracking, found.settling) == (None, None, None)


def test_a_run_that_never_touched_has_no_figures(ideal):
    found = figures(Trace(np.zeros(100), None, None, np.zeros((1, 2)), 8), FORCE, completed=False)
    assert found == (None, None, None, None, None, True)


@given(st.integers(0, 2900))
def test_settling_grows_with_the_time_outside(late):
    push = np.full(3000, FORCE)
    push[:late] = 0.0
    assert settling(push, FORCE) == pytest.approx(late * 1e-3, abs=0.025)


def row(**values):
    return {"unstable": False, "ending": "done", "overshoot": 0.1, "settling": 0.2,
            "rms_static": 0.01, "rms_tracking": 0.1, "peak": 11.0, **values}  # fmt: skip


VARIANT = Variant("soft", {}, stiffness=3e3, latency=6e-3)


def test_a_series_counts_unstable_runs_and_keeps_them_out_of_its_means():
    made = series(VARIANT, 125, [row(), row(rms_tracking=0.3), row(unstable=True, peak=40.0)])
    assert (made.runs, made.unstable, made.failed) == (3, 1, 0)
    assert made.rms_tracking == pytest.approx(0.2)
    assert made.peak == 40.0


def test_a_run_that_failed_is_neither_stable_nor_unstable():
    made = series(VARIANT, 125, [row(), {"failed": True, "unstable": False, "ending": "dead"}])
    assert (made.unstable, made.failed, made.endings) == (0, 1, ("dead",))


def test_a_series_without_a_stable_run_says_none_instead_of_a_number():
    made = series(VARIANT, 125, [row(unstable=True)])
    assert (made.settling_s, made.overshoot_p95, made.spread["rms_static"]) == (None, None, None)


@given(st.lists(st.floats(0.0, 100.0), min_size=3, max_size=20))
def test_the_interval_holds_the_mean(values):
    found = spread_of(values)
    assert found.low <= found.mean + 1e-9
    assert found.mean <= found.high + 1e-9


def test_the_ratio_is_a_geometric_mean_over_the_cells_where_both_are_stable():
    def of(law, stiffness, error, unstable=False):
        variant = Variant(law, {}, stiffness=stiffness)
        return series(variant, 125, [row(rms_tracking=error, unstable=unstable)])

    rows = [of("paper", 1e3, 0.4), of("paper", 3e3, 0.9), of("paper", 9e3, 5.0, unstable=True)]
    rows += [of("soft", stiffness, 0.1) for stiffness in (1e3, 3e3, 9e3)]
    assert ratio(rows, "paper", "soft", "rms_tracking") == pytest.approx(6.0)
