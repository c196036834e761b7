"""The two adaptive laws: what their update rules do by hand, what bounds them, where they hold."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.laws.adaptation import Adaptation, AdaptationSettings
from controller.laws.bounds import Bounds
from controller.laws.build import build
from controller.laws.duan import DuanSettings
from controller.laws.filtered import FilteredForce
from controller.laws.interface import AxisReading, Reference
from controller.laws.mass_damper import MassDamper
from controller.laws.paper_aic import Reading, as_printed
from hil.experiments.envelope.spring_loop import Span, run
from hil.experiments.envelope.spring_plant import SpringRig

OPEN = Bounds(
    approach=0.25, push=0.25, retreat=0.25, speed=0.25, acceleration=inf, stop=inf, sensor_range=1e6
)
PLAIN = AdaptationSettings(
    1.0, 0.1, 0.09, 0.1, 0.4, 1.5, 0.3, 0.4, 0.1, 0.1, 0.1, inf, inf, inf, 0.0, 0.0, freeze=False
)


def steadiness(name, config, stiffness):
    """Standard deviation of the true push in the last second, N."""
    axis = build(name, config, OPEN, 8_000_000)
    rng, ten = np.random.default_rng(3), Reference(10.0)
    rig = SpringRig(stiffness=stiffness)
    trace = run(axis, rig, lambda _: ten, Span(4000, 4000), period=8, rng=rng)
    return trace.push[-1000:].std()


def test_eq_26_by_hand_for_two_periods():
    adaptation = Adaptation(PLAIN, 0.5)
    adaptation.gains(2.0, 10.0, touching=True)  # delta 3
    gains = adaptation.gains(-1.0, 0.0, touching=True)  # delta -1
    assert gains.phi == pytest.approx(0.09 + 1.5 * 0.5 * (3.0 - 1.0) + 0.3 * -1.0)
    assert gains.proportional == pytest.approx(0.1 + 0.4 * 0.5 * (6.0 + 1.0) + 0.1 * 1.0)
    assert gains.derivative == pytest.approx(0.4 + 0.1 * 0.5 * (30.0 + 0.0) + 0.1 * 0.0)


@given(st.lists(st.tuples(st.floats(-500, 500), st.floats(-1e4, 1e4)), max_size=50))
def test_bounded_gains_stay_bounded_whatever_the_error(errors):
    config = AdaptationSettings(p2=1.0, p3=0.1)
    adaptation = Adaptation(config, 8e-3)
    for error, rate in errors:
        _, proportional, derivative = adaptation.gains(error, rate, touching=True)
        assert 0.0 <= proportional <= config.lp_max
        assert 0.0 <= derivative <= config.ld_max


def test_in_free_air_nothing_winds_up():
    adaptation = Adaptation(AdaptationSettings(p2=1.0), 8e-3)
    first = adaptation.gains(-10.0, 0.0, touching=False)
    for _ in range(10_000):
        last = adaptation.gains(-10.0, 0.0, touching=False)
    assert last == first


def test_as_printed_the_gains_wind_up_in_free_air():
    adaptation = Adaptation(PLAIN, 8e-3)
    first = adaptation.gains(-10.0, 0.0, touching=False)
    for _ in range(1000):
        last = adaptation.gains(-10.0, 0.0, touching=False)
    assert last.proportional > 10.0 * first.proportional


def test_a_leak_brings_the_gains_back_and_a_dead_zone_keeps_noise_out():
    config = AdaptationSettings(p2=1.0, leak=5.0, dead_zone=0.5, lp_max=1.0, rho1=0.0)
    adaptation = Adaptation(config, 8e-3)
    for _ in range(100):
        raised = adaptation.gains(5.0, 0.0, touching=True).proportional
    for _ in range(1000):
        rested = adaptation.gains(0.4, 0.0, touching=True).proportional
    assert raised > 2.0 * config.lp0
    assert rested == pytest.approx(config.lp0, rel=1e-6)


def test_read_in_metres_the_printed_gains_are_unstable_from_1_n_per_mm_on():
    for p2 in (1e-4, 1e-2, 1.0):
        assert steadiness("paper", as_printed(Reading.METRES, p2), 1e3) > 1.0


def test_read_in_millimetres_the_printed_gains_hold_3_n_per_mm_and_fail_at_10():
    printed = as_printed(Reading.MILLIMETRES, 0.01)
    assert steadiness("paper", printed, 3e3) < 0.1
    assert steadiness("paper", printed, 10e3) > 1.0


def test_the_common_law_fails_on_a_stiff_contact_too():
    printed = DuanSettings(sigma=0.1, freeze=False)
    assert steadiness("duan", printed, 3e3) < 0.1
    assert steadiness("duan", printed, 30e3) > 1.0


def test_the_adapted_damping_leaves_no_error_on_a_moving_surface():
    axis = build("duan", DuanSettings(damping=1000.0, sigma=0.05), OPEN, 8_000_000)
    axis.reset(0.0)
    x = 0.0
    for count in range(3000):
        push = max(0.0, 1e4 * (2e-3 * count * 8e-3 - x))
        x += axis.step(AxisReading(count * 8_000_000, (push,)), Reference(5.0))
    assert push == pytest.approx(5.0, abs=1e-6)


def test_sigma_means_the_same_at_125_and_500_hz():
    speeds = []
    for period, count in ((8_000_000, 50), (2_000_000, 200)):
        axis = build("duan", DuanSettings(mass=1e-6), OPEN, period)
        axis.reset(0.0)
        for index in range(count):
            axis.step(AxisReading(index * period, (7.0,)), Reference(5.0))
        speeds.append(axis.velocity)
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-9)


@pytest.mark.parametrize("samples", [8, 1])
@given(st.floats(0.5, 5.0), st.floats(-1e3, 1e3))
def test_the_filter_follows_a_ramp_with_its_true_rate(samples, cutoff, slope):
    force, dt = FilteredForce(cutoff, 8e-3), 8e-3 / samples
    course = [slope * dt * index for index in range(samples * round(400 / cutoff))]
    for start in range(0, len(course), samples):
        force.feed(tuple(course[start : start + samples]))
    # Two discrete poles z = exp(-w dt) see a ramp's rate as w dt z / (1 - z) of itself.
    lag = 2.0 * np.pi * cutoff * dt
    assert force.rate == pytest.approx(slope * lag * np.exp(-lag) / -np.expm1(-lag), rel=0.01)


@given(st.floats(0.1, 100.0), st.floats(1.0, 1e4), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_mass_and_damper_do_the_same_in_four_short_periods_as_in_one(m, b, speed, wanted):
    short, whole = MassDamper(m, b, 2e-3), MassDamper(m, b, 8e-3)
    once, often = whole.after(speed, wanted), speed
    for _ in range(4):
        often = short.after(often, wanted)
    assert often == pytest.approx(once, abs=1e-12)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [({"p2": 0.0}, "p2 > 0"), ({"mu1": -1.0}, "mu1 must not"), ({"lp0": 1.0}, "beyond lp_max")],
)
def test_gains_without_sense_are_refused(wrong, says):
    with pytest.raises(ValueError, match=says):
        replace(AdaptationSettings(), **wrong)
