from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.alignment import AlignedPosition
from controller.reference import Ramp, Sine, Slide, Step

PROFILES = [Step(10.0), Ramp(5.0, 12.0, 2.0), Sine(10.0, 3.0, 0.7)]


@pytest.mark.parametrize("profile", PROFILES)
@given(t=st.floats(0.0, 10.0))
def test_the_rate_is_the_forces_derivative(profile, t):
    h = 1e-5
    # Not across a corner of the profile, where it has none.
    if any(abs(t - corner) < 2 * h for corner in (1.0, 3.0)):
        return
    slope = (profile.at(t + h).force - profile.at(t - h).force) / (2 * h)
    assert profile.at(t).rate == pytest.approx(slope, abs=1e-3)


@pytest.mark.parametrize("profile", PROFILES)
@given(t=st.floats(-1.0, 100.0))
def test_every_profile_keeps_pressing(profile, t):
    assert profile.at(t).force > 0.0


def test_a_ramp_ends_where_it_should():
    ramp = Ramp(5.0, 12.0, 2.0, rest=1.0)
    assert [ramp.at(t).force for t in (0.0, 1.0, 2.0, 3.0, 9.0)] == [5.0, 5.0, 8.5, 12.0, 12.0]


@given(st.floats(0.0, 20.0), st.floats(1e-3, 0.1), st.floats(0.01, 1.0))
def test_a_slide_never_exceeds_its_speed_or_acceleration(t, speed, acceleration):
    slide, h = Slide(speed, acceleration), 1e-3
    here, after, later = (slide.at(t + k * h) for k in range(3))
    assert -1e-12 <= after - here <= speed * h + 1e-12
    assert abs(later - 2 * after + here) <= acceleration * h * h + 1e-12


@pytest.mark.parametrize(
    "wrong",
    [lambda: Step(0.0), lambda: Step(nan), lambda: Ramp(5.0, inf, 1.0), lambda: Ramp(5.0, 6.0, 0.0),
     lambda: Sine(5.0, 5.0, 1.0), lambda: Slide(nan), lambda: Slide(0.02, 0.0)],
)  # fmt: skip
def test_a_profile_that_cannot_be_held_is_refused(wrong):
    with pytest.raises(ValueError, match=r"positive|lost|finite"):
        wrong()


@given(st.integers(0, 40_000_000), st.floats(-0.1, 0.1))
def test_an_aligned_position_on_a_ramp_is_the_position_then(age, speed):
    aligned, period = AlignedPosition(8_000_000), 8_000_000
    for k in range(30):
        t = k * period
        place = aligned.at(t, speed * t * 1e-9, age)
    assert place == pytest.approx(speed * (t - age) * 1e-9, abs=1e-12)


def test_a_position_older_than_any_kept_is_the_oldest():
    aligned = AlignedPosition(8_000_000)
    aligned.at(0, 1.0, 0)
    assert aligned.at(8_000_000, 2.0, 1_000_000_000) == 1.0
