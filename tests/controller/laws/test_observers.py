"""The tracker's parts, each alone: surface, stiffness, delay, measured position."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.laws.bounds import Bounds
from controller.laws.delay import LoopDelay
from controller.laws.measured import MeasuredPosition
from controller.laws.motion import Motion
from controller.laws.stiffness import Stiffness, StiffnessSettings
from controller.laws.surface import SurfaceObserver

T = 8e-3


def loaded(stiffness, k, wanted=10.0, speed=2e-3, periods=300, force=0.0):
    """Feed a spring of k (N/m) loaded at a constant speed (m/s) up to the reference."""
    for index in range(periods):
        push = min(force + k * speed * T * index, wanted)
        stiffness.observe(push, -push / k, wanted)


@given(st.floats(-5e-3, 5e-3), st.floats(5.0, 40.0))
def test_the_observer_finds_place_and_speed_of_a_moving_surface(speed, bandwidth):
    observer = SurfaceObserver(0.02, T)
    observer.start(0.1)
    for count in range(600):
        observer.observe(0.1 + speed * count * T, bandwidth)
    assert observer.speed == pytest.approx(speed, abs=1e-6)
    assert observer.ahead(T) == pytest.approx(0.1 + speed * 600 * T, abs=1e-6)


@given(st.lists(st.floats(-1.0, 1.0), max_size=50))
def test_the_surfaces_speed_stays_bounded(places):
    observer = SurfaceObserver(0.02, T)
    for place in places:
        observer.observe(place, 30.0)
        assert abs(observer.speed) <= 0.02


@given(st.floats(1.5e3, 40e3))
def test_loading_shows_the_contacts_stiffness_times_the_margin(k):
    stiffness = Stiffness(StiffnessSettings(), T)
    speed = min(2e-3, 10.0 / k / 0.5)  # ten newtons in half a second at least
    loaded(stiffness, k, speed=speed)
    assert stiffness.value == pytest.approx(1.15 * k, rel=0.1)


def test_every_touch_begins_at_the_stiffest():
    stiffness = Stiffness(StiffnessSettings(), T)
    loaded(stiffness, 2e3)
    stiffness.lift()
    assert stiffness.value == 50e3


def test_missing_readings_drop_the_window_and_keep_the_value():
    stiffness = Stiffness(StiffnessSettings(), T)
    loaded(stiffness, 2e3)
    before = stiffness.value
    stiffness.forget()
    assert stiffness.value == before


def test_a_blow_is_believed_at_once_and_forbids_softening_for_a_while():
    stiffness = Stiffness(StiffnessSettings(), T)
    loaded(stiffness, 2e3, wanted=5.0)
    stiffness.observe(5.5, -2.5e-3 - 2e-5, 5.0)
    stiffness.observe(7.5, -2.5e-3 - 6e-5, 5.0)
    struck = stiffness.value
    assert struck > 20e3
    loaded(stiffness, 2e3, wanted=9.0, periods=60, force=7.5)
    assert stiffness.value == struck


def test_unloading_never_softens():
    stiffness = Stiffness(StiffnessSettings(), T)
    stiffness.observe(10.0, -5e-3, 10.0)
    for index in range(100):
        push = 10.0 - 0.04 * index
        stiffness.observe(push, -push / 2e3, 10.0)
    assert stiffness.value == 50e3


def test_an_approach_at_constant_speed_shows_the_loops_delay():
    motion, delay = Motion(Bounds(), T), LoopDelay(0.028, 0.004, 0.084, T)
    motion.reset(0.0)
    for _ in range(100):
        motion.advance(-2.5e-3)
        delay.observe(motion.position + 2.5e-3 * 0.02, motion)
    assert delay.value == pytest.approx(0.02, rel=1e-3)


@pytest.mark.parametrize("measured", [None, 1.0, -1.0])
def test_the_delay_stays_in_its_range_whatever_is_measured(measured):
    motion, delay = Motion(Bounds(), T), LoopDelay(0.028, 0.004, 0.084, T)
    motion.reset(0.0)
    for _ in range(200):
        motion.advance(-2.5e-3)
        delay.observe(measured, motion)
        assert 0.004 <= delay.value <= 0.084


def test_a_short_approach_leaves_the_prior():
    motion, delay = Motion(Bounds(), T), LoopDelay(0.028, 0.004, 0.084, T)
    motion.reset(0.0)
    for _ in range(20):
        motion.advance(-2.5e-3)
        delay.observe(motion.position, motion)
    assert delay.value == 0.028


def test_the_standing_offset_is_taken_out_and_the_window_is_averaged():
    measured = MeasuredPosition(0.01, 2)
    for _ in range(2):
        measured.rest(0.1003, 0.1)
        measured.over_window(0.1003, 0.1)
    assert measured.over_window(0.1003 - 1e-3, 0.1) == pytest.approx(0.1 - 0.5e-3)


@pytest.mark.parametrize("position", [None, 0.2, 1e300, float("inf")])
def test_a_position_that_is_missing_or_far_from_the_command_is_none(position):
    measured = MeasuredPosition(0.01, 0)
    measured.over_window(0.1, 0.1)
    assert measured.over_window(position, 0.1) is None


@pytest.mark.parametrize(
    ("wrong", "says"),
    [({"softest": 60e3}, "softest < stiffest"), ({"loud": 0.0}, "loud must be positive")],
)
def test_a_range_without_sense_is_refused(wrong, says):
    with pytest.raises(ValueError, match=says):
        StiffnessSettings(**wrong)


@given(st.floats(0.0, 0.09))
def test_the_command_of_some_time_ago_lies_between_its_neighbours(delay):
    motion = Motion(Bounds(acceleration=1e3), T)
    motion.reset(0.0)
    for _ in range(50):
        motion.advance(5e-3)
    assert motion.ago(delay) == pytest.approx(motion.position - 5e-3 * delay, abs=1e-12)
