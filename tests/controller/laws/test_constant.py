from math import exp, inf, pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.laws.bounds import Bounds
from controller.laws.build import build
from controller.laws.constant import ConstantSettings
from controller.laws.interface import AxisReading, Reference

OMEGA = 2 * pi * 22.0


FIRM = Reference(5.0)


def axis(mass, damping, period):
    bounds = Bounds(
        approach=inf, push=inf, retreat=inf, speed=inf, acceleration=inf, stop=inf, contact=1e-9
    )
    return build("constant", ConstantSettings(mass, damping), bounds, round(period * 1e9))


def press(law, period, stiffness, seconds):
    """Force every period against a spring met by an arm with 22 Hz critically damped lag."""
    law.reset(0.0)
    x = actual = speed = 0.0
    forces = []
    for count in range(round(seconds / period)):
        force = max(0.0, -stiffness * actual)
        forces.append(force)
        x += law.step(AxisReading(round(count * period * 1e9), (force,)), FIRM)
        error, slope = actual - x, speed + OMEGA * (actual - x)
        decay = exp(-OMEGA * period)
        actual = x + (error + slope * period) * decay
        speed = (speed - OMEGA * slope * period) * decay
    return forces


@settings(deadline=None)
@given(st.floats(1e3, 50e3), st.sampled_from([0.008, 0.002]))
def test_damping_of_50_ms_times_stiffness_never_overshoots(stiffness, period):
    law = axis(1e-3 * 0.05 * stiffness, 0.05 * stiffness, period)  # m/b = 1 ms
    assert max(press(law, period, stiffness, 2.0)) <= 5.0 * 1.001


@settings(deadline=None)
@given(st.floats(1e3, 50e3), st.sampled_from([0.008, 0.002]))
def test_it_settles_at_the_force_asked_for(stiffness, period):
    law = axis(1.0, 0.05 * stiffness, period)
    assert press(law, period, stiffness, 2.0)[-1] == pytest.approx(5.0, rel=1e-3)


def test_too_little_damping_rings():
    assert max(press(axis(1.0, 100.0, 0.008), 0.008, 16.5e3, 2.0)) > 7.0


def test_125_and_500_hz_give_the_same_motion():
    slow = press(axis(1.0, 1000.0, 0.008), 0.008, 16.5e3, 1.0)
    fast = press(axis(1.0, 1000.0, 0.002), 0.002, 16.5e3, 1.0)[::4]
    assert max(abs(a - b) for a, b in zip(slow, fast, strict=True)) < 0.25


@given(st.floats(0.1, 100.0), st.floats(1.0, 1e4), st.floats(0.5, 40.0))
def test_without_force_error_the_motion_dies_out_without_changing_sign(m, b, push):
    law = axis(m, b, 0.008)
    law.reset(0.0)
    law.step(AxisReading(0, (push,)), FIRM)
    before = law.velocity
    law.step(AxisReading(8_000_000, (5.0,)), FIRM)
    assert abs(law.velocity) <= abs(before)
    assert law.velocity * before >= 0.0


def test_a_moving_surface_leaves_a_steady_error_of_damping_times_speed():
    law = axis(1.0, 1000.0, 0.008)
    law.reset(0.0)
    x = 0.0
    for count in range(1000):
        surface = 2e-3 * count * 0.008
        force = max(0.0, 1e4 * (surface - x))
        x += law.step(AxisReading(count * 8_000_000, (force,)), FIRM)
    assert force == pytest.approx(5.0 + 1000.0 * 2e-3, rel=1e-3)


@pytest.mark.parametrize("bad", [(0.0, 1.0), (1.0, -1.0), (float("nan"), 1.0)])
def test_a_law_without_mass_or_damping_is_refused(bad):
    with pytest.raises(ValueError, match="must be positive"):
        ConstantSettings(*bad)
