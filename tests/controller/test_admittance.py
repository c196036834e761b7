from math import exp, pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.admittance import Admittance

OMEGA = 2 * pi * 22.0


def press(law, stiffness, seconds, lag=True):
    """Force every period against a spring met by an arm with 22 Hz critically damped lag."""
    x = actual = speed = velocity = 0.0
    forces = []
    for _ in range(round(seconds / law.period)):
        force = max(0.0, -stiffness * actual)
        forces.append(force)
        velocity = law.velocity(velocity, force - 5.0)
        x += velocity * law.period
        error, slope = actual - x, speed + OMEGA * (actual - x)
        decay = exp(-OMEGA * law.period) if lag else 0.0
        actual = x + (error + slope * law.period) * decay
        speed = (speed - OMEGA * slope * law.period) * decay
    return forces


@settings(deadline=None)
@given(st.floats(1e3, 50e3), st.sampled_from([0.008, 0.002]))
def test_damping_of_50_ms_times_stiffness_never_overshoots(stiffness, period):
    law = Admittance(1e-3 * 0.05 * stiffness, 0.05 * stiffness, period)  # m/b = 1 ms
    assert max(press(law, stiffness, 2.0)) <= 5.0 * 1.001


@settings(deadline=None)
@given(st.floats(1e3, 50e3), st.sampled_from([0.008, 0.002]))
def test_it_settles_at_the_force_asked_for(stiffness, period):
    law = Admittance(1.0, 0.05 * stiffness, period)
    assert press(law, stiffness, 2.0)[-1] == pytest.approx(5.0, rel=1e-3)


def test_too_little_damping_rings():
    assert max(press(Admittance(1.0, 100.0, 0.008), 16.5e3, 2.0)) > 7.0


def test_125_and_500_hz_give_the_same_motion():
    slow = press(Admittance(1.0, 1000.0, 0.008), 16.5e3, 1.0)
    fast = press(Admittance(1.0, 1000.0, 0.002), 16.5e3, 1.0)[::4]
    assert max(abs(a - b) for a, b in zip(slow, fast, strict=True)) < 0.25


@given(st.floats(0.1, 100.0), st.floats(1.0, 1e4), st.floats(1e-3, 2e-2), st.floats(-1.0, 1.0))
def test_without_force_error_the_motion_dies_out_without_changing_sign(m, b, period, v):
    after = Admittance(m, b, period).velocity(v, 0.0)
    assert abs(after) <= abs(v)
    assert after * v >= 0.0


@pytest.mark.parametrize("bad", [(0.0, 1.0, 0.008), (1.0, -1.0, 0.008), (1.0, 1.0, 0.0)])
def test_a_law_without_mass_damping_or_period_is_refused(bad):
    with pytest.raises(ValueError, match="must be positive"):
        Admittance(*bad)
