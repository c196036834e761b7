"""The safety envelope of one axis: what no reading, no law and no reference can break."""

from dataclasses import replace
from math import ceil, inf, isfinite, nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.laws.bounds import Bounds
from controller.laws.build import build, laws
from controller.laws.governor import Governor
from controller.laws.interface import AxisReading, Reference

START = 0.193
BOUNDS = Bounds(lowest=0.18, highest=0.2)
HOSTILE = st.one_of(
    st.sampled_from([nan, inf, -inf, 1e300, -1e300, 1e160, -0.0, 499.0, -499.0]),
    st.floats(-2.0, 11.9),
    st.floats(allow_nan=True, allow_infinity=True),
)
READINGS = st.lists(
    st.tuples(
        st.lists(HOSTILE, max_size=8).map(tuple),
        st.one_of(st.none(), st.floats(0.18, 0.2), st.floats(allow_nan=True)),
        st.sampled_from([1, 1, 1, 1, 0, 2, 40, -3]),
    ),
    min_size=20,
    max_size=60,
)
PERIODS = st.sampled_from([8_000_000, 2_000_000])
ANY_LAW = pytest.mark.parametrize("name", sorted(laws()))


def axis_of(name, period, bounds=BOUNDS):
    axis = build(name, None, bounds, period)
    axis.reset(START)
    return axis


def timed(readings, period):
    t = 0
    for push, place, periods in readings:
        t += periods * period
        yield AxisReading(t, push, place)


class Reckless:
    """Proposes whatever it is told to."""

    def __init__(self, wanted):
        self.wanted = wanted

    def reset(self, position):
        pass

    def velocity(self, felt, motion, reference):
        return self.wanted


@ANY_LAW
@settings(deadline=None, max_examples=25)
@given(READINGS, PERIODS, st.floats(allow_nan=True))
def test_steps_speed_changes_and_travel_stay_bounded_whatever_is_read(
    name, readings, period, force
):
    axis, seconds = axis_of(name, period), period * 1e-9
    for reading in timed(readings, period):
        before = axis.velocity
        step = axis.step(reading, Reference(force, force, force))
        assert isfinite(step)
        assert abs(step) <= BOUNDS.speed * seconds * (1 + 1e-9)
        assert BOUNDS.lowest <= axis.position <= BOUNDS.highest
        if BOUNDS.lowest < axis.position < BOUNDS.highest:
            assert abs(axis.velocity - before) <= BOUNDS.acceleration * seconds * (1 + 1e-9)


@settings(deadline=None, max_examples=40)
@given(READINGS, PERIODS)
def test_the_trackers_estimates_stay_in_their_ranges(readings, period):
    law = laws()["soft"](laws()["soft"].Settings(), BOUNDS, period * 1e-9)
    axis = Governor(law, BOUNDS, period)
    axis.reset(START)
    for reading in timed(readings, period):
        axis.step(reading, Reference(5.0))
        assert 1e3 <= law.stiffness.value <= 50e3
        assert 0.004 <= law.delay.value <= 0.084
        assert abs(law.surface.speed) <= 0.02
        assert isfinite(law.surface.place)


@ANY_LAW
@settings(deadline=None, max_examples=25)
@given(READINGS, PERIODS)
def test_it_stands_still_within_the_braking_time_of_the_last_reading(name, readings, period):
    axis = axis_of(name, period)
    t = 0
    for reading in timed(readings, period):
        axis.step(reading, Reference(5.0))
        t = max(t, reading.t)
    braking = ceil(BOUNDS.speed / (BOUNDS.acceleration * period * 1e-9) - 1e-9)
    speeds = []
    for index in range(braking + 10):
        axis.step(AxisReading(t + (index + 1) * period, ()), Reference(5.0))
        speeds.append(axis.velocity)
    assert speeds[braking - 1 :] == [0.0] * 11


@ANY_LAW
@settings(deadline=None, max_examples=25)
@given(READINGS, PERIODS)
def test_off_the_surface_it_goes_inward_no_faster_than_the_approach(name, readings, period):
    fast = replace(BOUNDS, push=40e-3, lowest=-inf, highest=inf, stop=inf)
    axis = axis_of(name, period, fast)
    t = 0
    for reading in timed(readings, period):
        axis.step(reading, Reference(5.0))
        t = max(t, reading.t)
    slowing = ceil((fast.speed - fast.approach) / (fast.acceleration * period * 1e-9) - 1e-9)
    for index in range(slowing + 5):
        axis.step(AxisReading(t + (index + 1) * period, (0.0,), None), Reference(5.0))
        assert index < slowing or axis.velocity >= -fast.approach * (1 + 1e-9)


@ANY_LAW
@settings(deadline=None, max_examples=25)
@given(READINGS, PERIODS)
def test_one_sample_above_the_force_stop_ends_every_inward_motion(name, readings, period):
    axis = axis_of(name, period)
    axis.step(AxisReading(0, (1.0, 12.5, 1.0)), Reference(5.0))
    assert axis.tripped
    braking = ceil(BOUNDS.speed / (BOUNDS.acceleration * period * 1e-9) - 1e-9)
    t = 0
    for index, reading in enumerate(timed(readings, period)):
        t = max(t + 1, reading.t)
        axis.step(reading._replace(t=t), Reference(5.0))
        assert index < braking or axis.velocity >= 0.0
    assert axis.tripped
    axis.reset(START)
    assert not axis.tripped


@ANY_LAW
def test_after_a_force_stop_it_starts_without_anything_wound_up(name):
    fresh, used = axis_of(name, 8_000_000), axis_of(name, 8_000_000)
    for index in range(400):
        used.step(AxisReading(index * 8_000_000, (9.0,), START), Reference(5.0))
    used.step(AxisReading(400 * 8_000_000, (99.0,), START), Reference(5.0))
    used.reset(START)
    readings = [AxisReading(index * 8_000_000, (index % 7.0,), START) for index in range(200)]
    assert [fresh.step(r, Reference(5.0)) for r in readings] == [
        used.step(r, Reference(5.0)) for r in readings
    ]


@given(st.floats(allow_nan=True), PERIODS)
def test_a_law_cannot_propose_its_way_out_of_the_bounds(wanted, period):
    axis = Governor(Reckless(wanted), BOUNDS, period)
    axis.reset(START)
    for index in range(50):
        axis.step(AxisReading(index * period, (2.0,)), Reference(5.0))
        assert -BOUNDS.push <= axis.velocity <= BOUNDS.retreat


def test_a_command_held_over_skipped_periods_is_remembered_as_held():
    axis = Governor(law := Reckless(-2e-3), BOUNDS, 8_000_000)
    axis.reset(START)
    axis.step(AxisReading(0, (2.0,)), Reference(5.0))
    held = axis.position
    seen = []
    law.velocity = lambda felt, motion, reference: seen.append(motion.ago(0.024)) or 0.0
    axis.step(AxisReading(5 * 8_000_000, (2.0,)), Reference(5.0))
    assert seen == [pytest.approx(held)]


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"approach": 0.0}, "approach must be positive"),
        ({"acceleration": nan}, "acceleration must be positive"),
        ({"contact": 13.0}, "0 < contact < stop"),
        ({"sensor_range": inf}, "sensor_range must be finite"),
        ({"lowest": 1.0, "highest": 0.0}, "travel from 1.0 to 0.0 m is empty"),
    ],
)
def test_bounds_that_bound_nothing_are_refused(wrong, says):
    with pytest.raises(ValueError, match=says):
        Bounds(**wrong)


@pytest.mark.parametrize("force", [0.0, 0.4, 12.0, -5.0, nan])
def test_a_reference_force_that_no_contact_holds_is_refused(force):
    with pytest.raises(ValueError, match=r"between 0.4 and 12.0 N"):
        BOUNDS.check(force)


def test_an_axis_outside_its_travel_is_refused_before_it_moves():
    with pytest.raises(ValueError, match="its travel is"):
        axis_of("soft", 8_000_000, Bounds(lowest=0.0, highest=0.1))
