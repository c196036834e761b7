import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.arm.urscript.builtins.trapezoid import lasting, limited

sizes = st.floats(1e-4, 10.0)


@given(sizes, sizes, sizes)
def test_limits_are_kept_and_the_way_is_finished(way, speed, acceleration):
    profile = limited(way, speed, acceleration)
    peak = way / (profile.duration - profile.ramp)
    assert peak <= speed * (1 + 1e-9)
    assert peak / profile.ramp == pytest.approx(acceleration)
    assert profile.fraction(profile.duration) == 1.0


@given(sizes, sizes, sizes, st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_motion_never_goes_back(way, speed, acceleration, a, b):
    profile = limited(way, speed, acceleration)
    early, late = sorted((a * profile.duration, b * profile.duration))
    assert 0.0 <= profile.fraction(early) <= profile.fraction(late) + 1e-12 <= 1.0 + 1e-12


@given(sizes, sizes, sizes, st.floats(0.0, 1.0))
def test_second_half_mirrors_the_first(way, speed, acceleration, part):
    profile = limited(way, speed, acceleration)
    t = part * profile.duration
    mirrored = 1.0 - profile.fraction(profile.duration - t)
    assert profile.fraction(t) == pytest.approx(mirrored, abs=1e-9)


def test_given_time_is_kept():
    profile = lasting(3.0, 1.0, 10.0, 10.0)
    assert [profile.fraction(t) for t in (0.0, 1.5, 3.0)] == pytest.approx([0.0, 0.5, 1.0])


@given(sizes, sizes, sizes, sizes)
def test_a_time_too_short_for_the_limits_is_lengthened(duration, way, speed, acceleration):
    profile = lasting(duration, way, acceleration, speed)
    cruise = way / (profile.duration - profile.ramp)
    assert profile.duration >= duration
    assert cruise <= speed * (1 + 1e-9)
    assert profile.duration == pytest.approx(duration) or cruise / profile.ramp <= acceleration * (
        1 + 1e-9
    )
