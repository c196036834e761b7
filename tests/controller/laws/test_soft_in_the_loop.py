"""The tracker on the spring plant: what it holds, and what each of its parts is for."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.laws.bounds import Bounds, approach_speed, reaction_time
from controller.laws.build import build
from controller.laws.interface import AxisReading, Reference
from controller.laws.soft import SoftSettings
from controller.laws.stiffness import StiffnessSettings
from hil.experiments.envelope.experiment import FAMILIES
from hil.experiments.envelope.spring_loop import Span, run
from hil.experiments.envelope.spring_plant import SpringRig
from hil.experiments.envelope.verdict import verdict

WIDE = SoftSettings(stiffness=StiffnessSettings(softest=500.0, stiffest=100e3))
BOUNDS = Bounds(approach=4e-3, push=16e-3, stop=inf)
TEN = Reference(10.0)
STILL = Span(4000, 3000)


def pressed(rig, config=WIDE, *, bounds=BOUNDS, period=8, span=STILL, spoil=None):
    """True push from the touch on."""
    axis = build("soft", config, bounds, period * 1_000_000)
    rng = np.random.default_rng(1)
    trace = run(axis, rig, lambda _: TEN, span, period=period, rng=rng, spoil=spoil)
    return trace.push[trace.touch :]


def held(delay, stiffness=None):
    """The tracker with its delay (s), and its stiffness (N/m) if given, held for good."""
    found = WIDE.stiffness
    if stiffness is not None:
        found = StiffnessSettings(softest=stiffness * (1.0 - 1e-9), stiffest=stiffness)
    return replace(WIDE, delay=delay, shortest=delay, longest=delay, stiffness=found)


def probe(axis, origin, factor):
    """Commands relative to the origin on a 5 N/mm spring 1 mm away, all forces scaled."""
    x, commands = origin, []
    for count in range(400):
        push = max(0.0, 5e3 * factor * (origin - 1e-3 - x))
        x += axis.step(AxisReading(count * 8_000_000, (push,), x), Reference(10.0 * factor))
        commands.append(x - origin)
    return commands


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_random_loops_stay_stable_and_below_the_peak_bound(family):
    for rng in np.random.default_rng(77).spawn(5):
        found = verdict(family, rng)
        assert not found.unstable
        assert found.peak_over_bound <= 1.03 or family.free_approach


@settings(deadline=None, max_examples=10)
@given(st.floats(1e3, 30e3), st.sampled_from([8, 2]), st.integers(1, 5))
def test_overshoot_and_steady_error_stay_small_on_any_stiffness(stiffness, period, latency):
    rig = SpringRig(stiffness=stiffness, sensor_latency=latency, command_latency=latency)
    push = pressed(rig, period=period)
    assert push.max() <= 11.2
    assert push[-1000:].mean() == pytest.approx(10.0, abs=0.05)
    assert push[50:].min() > 0.02


@settings(deadline=None, max_examples=10)
@given(st.floats(1e3, 30e3), st.floats(-2e-3, 2e-3), st.floats(0.016, 0.04), st.floats(1.0, 3.0))
def test_a_surface_of_constant_speed_leaves_no_error_whatever_is_believed(k_e, speed, delay, ratio):
    axis = build("soft", held(delay, ratio * k_e), BOUNDS, 8_000_000)
    axis.reset(0.0)
    sent = [0.0] * 3
    for count in range(1500):
        surface = -0.5e-3 + speed * count * 8e-3
        push = max(0.0, k_e * (surface - sent[-3]))
        step = axis.step(AxisReading(count * 8_000_000, (push,)), TEN)
        sent = [*sent[1:], sent[-1] + step]
    assert push == pytest.approx(10.0, abs=1e-9)


@pytest.mark.parametrize(
    ("ratio", "delays"),
    [(0.5, 0.75), (0.5, 1.4), (0.6, 0.5), (0.6, 3.0), (1.0, 0.5), (1.0, 3.0), (10.0, 0.5)],
)
def test_it_stays_stable_with_stiffness_and_delay_held_wrong(ratio, delays):
    push = pressed(SpringRig(stiffness=10e3), held(0.0217 * delays, ratio * 10e3))
    assert push[-1000:].std() < 0.2
    assert push[1000:].min() > 0.2


def test_a_stiffness_held_far_too_low_is_what_makes_it_unstable():
    push = pressed(SpringRig(stiffness=100e3), held(0.022, 10e3))
    assert push[-1000:].std() > 1.0


def test_without_prediction_it_overshoots_far_more():
    rig = SpringRig(stiffness=30e3, sensor_latency=5, command_latency=5)
    assert pressed(rig).max() < 10.8
    assert pressed(rig, held(0.004)).max() > 11.5


def test_without_adapting_its_stiffness_it_settles_far_later_on_a_soft_contact():
    rig, deaf = SpringRig(stiffness=2e3), replace(WIDE.stiffness, loud=inf)
    assert abs(pressed(rig)[600] - 10.0) < 0.5
    assert abs(pressed(rig, replace(WIDE, stiffness=deaf))[600] - 10.0) > 0.5


def test_without_the_surfaces_speed_it_lags_a_moving_surface():
    rig, span = SpringRig(stiffness=3e3), Span(4000, 2000, 3000)
    error = pressed(rig, span=span)[2500:] - 10.0
    slow = pressed(rig, replace(WIDE, surface_speed=1e-9), span=span)[2500:] - 10.0
    assert slow.std() > 3.0 * error.std()


def test_bursts_without_samples_leave_force_and_peak_in_place():
    def lossy(reading):
        gone = reading.t // 8_000_000 % 50 < 6 or reading.t // 8_000_000 % 7 == 0
        return reading._replace(push=()) if gone else reading

    push = pressed(SpringRig(stiffness=10e3), span=Span(4000, 5000), spoil=lossy)
    assert push.max() <= 11.2
    assert push[-1000:].mean() == pytest.approx(10.0, abs=0.03)


@pytest.mark.parametrize("bias", [-1.0, 1.0])
def test_a_sensors_bias_shifts_the_true_force_by_itself_and_nothing_else(bias):
    def biased(reading):
        return reading._replace(push=tuple(sample + bias for sample in reading.push))

    # Above the contact threshold a bias would be a contact: tare at rest.
    bounds = replace(BOUNDS, contact=1.5)
    push = pressed(SpringRig(stiffness=10e3), bounds=bounds, spoil=biased)
    assert push[-1000:].mean() == pytest.approx(10.0 - bias, abs=0.03)


def test_the_origin_of_the_axis_does_not_matter():
    steps = []
    for origin in (0.0, 0.4):
        axis = build("soft", WIDE, BOUNDS, 8_000_000)
        axis.reset(origin)
        steps.append(probe(axis, origin, 1.0))
    assert steps[0] == pytest.approx(steps[1], abs=4e-6)


def test_scaling_every_force_and_stiffness_leaves_the_motion_unchanged():
    motions = []
    for factor in (1.0, 4.0):
        stiffness = StiffnessSettings(500.0 * factor, 100e3 * factor, loud=0.5 * factor)
        bounds = replace(BOUNDS, contact=0.4 * factor)
        axis = build("soft", replace(WIDE, stiffness=stiffness), bounds, 8_000_000)
        axis.reset(0.0)
        motions.append(probe(axis, 0.0, factor))
    assert motions[0] == pytest.approx(motions[1], abs=1e-12)


def test_a_kink_from_2_to_50_n_per_mm_peaks_below_8_n():
    five = Reference(5.0)
    config = SoftSettings()
    for kink in (3.0, 4.8):
        for seed in range(3):
            axis = build("soft", config, Bounds(stop=inf), 8_000_000)
            rig = SpringRig(stiffness=2e3, kink=kink, beyond=50e3)
            rng = np.random.default_rng(seed)
            span = Span(5000, 4000)
            trace = run(axis, rig, lambda _: five, span, period=8, rng=rng)
            assert trace.push.max() < 8.0
            assert trace.push[-1000:].mean() == pytest.approx(5.0, abs=0.05)


def test_the_approach_rule_keeps_the_first_blow_below_the_reference():
    reaction = reaction_time(0.016, 0.03, 0.008)
    bounds = replace(BOUNDS, approach=approach_speed(10.0, 0.4, 100e3, reaction))
    rig = SpringRig(stiffness=100e3, sensor_latency=8, command_latency=8, lag=0.03)
    near = replace(rig, gap=2e-3)
    assert pressed(near, bounds=bounds)[:60].max() < 10.0
