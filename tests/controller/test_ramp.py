import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.ramp import ramp, ramp_periods

step = st.floats(-0.02, 0.02)


@given(step, step, step, st.integers(1, 50))
def test_the_increments_add_up_to_the_step(dx, dy, dtheta, periods):
    increments = list(ramp(dx, dy, dtheta, periods))
    assert len(increments) == periods
    for axis, whole in enumerate((dx, dy, dtheta)):
        assert sum(i[axis] for i in increments) == pytest.approx(whole, abs=1e-15)


@pytest.mark.parametrize(("period", "periods"), [(0.008, 6), (0.002, 24), (0.1, 1)])
def test_a_ramp_lasts_48_ms_at_any_rate(period, periods):
    assert ramp_periods(period) == periods
