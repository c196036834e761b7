from dataclasses import replace
from math import isfinite

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.cycle import Cycle
from controller.errors import GuardTrip, Trip
from controller.guard import Guard, Limits
from controller.place import Place
from drivers.interfaces import ArmState, Freshness, RobotMode, SafetyMode, WrenchReading

PERIOD = 8_000_000
HERE = Place(0.0, 0.0, 0.01, 0.0)
ZERO = (0.0,) * 6
number = st.floats(-20.0, 20.0) | st.sampled_from([float("nan"), float("inf"), -float("inf")])


def cycle(wrench=ZERO, stage=HERE, age=0):
    state = ArmState(0, ZERO, ZERO, ZERO, ZERO, RobotMode.RUNNING, SafetyMode.NORMAL, True, 0, 0)
    reading = WrenchReading(wrench, (wrench,), 1, age, Freshness.OK, True)
    return Cycle(0, state, reading, wrench, stage)


@pytest.fixture
def guard():
    return Guard(Limits(), PERIOD)


@given(st.tuples(number, number, number, number, number, number))
def test_what_passes_is_finite_and_within_every_bound(wrench):
    try:
        Guard(Limits(), PERIOD).check(cycle(wrench))
    except GuardTrip:
        return
    assert all(map(isfinite, wrench))
    measured = [abs(wrench[axis]) for axis in (0, 1, 2, 5)]
    assert all(m <= b for m, b in zip(measured, Limits().force_bound, strict=True))


@given(st.tuples(number, number, number, number))
def test_a_set_point_that_passes_is_finite_and_near_the_last_one(setpoint):
    try:
        Guard(Limits(), PERIOD).check_setpoint(Place(*setpoint), HERE)
    except GuardTrip:
        return
    assert all(map(isfinite, setpoint))
    assert max(abs(a - b) for a, b in zip(setpoint[:3], HERE[:3], strict=True)) <= 0.3 * 8e-3


@pytest.mark.parametrize(("axis", "bound"), [(0, 1.5), (1, 1.5), (2, 10.0), (5, 1.0)])
@pytest.mark.parametrize("sign", [1, -1])
def test_each_bound_holds_in_both_directions(guard, axis, bound, sign):
    wrench = list(ZERO)
    wrench[axis] = sign * bound
    guard.check(cycle(tuple(wrench)))
    wrench[axis] = sign * (bound + 1e-6)
    with pytest.raises(GuardTrip) as caught:
        guard.check(cycle(tuple(wrench)))
    assert caught.value.trip is Trip.FORCE
    assert caught.value.allowed == bound


def test_moments_that_the_paper_does_not_bound_do_not_trip(guard):
    guard.check(cycle((0.0, 0.0, 0.0, 5.0, 5.0, 0.0)))


def test_a_sample_beyond_its_age_trips(guard):
    guard.check(cycle(age=10_000_000))
    with pytest.raises(GuardTrip, match="sample age"):
        guard.check(cycle(age=10_000_001))


@pytest.mark.parametrize(
    ("setpoint", "trip"),
    [
        (HERE._replace(x=0.26), Trip.WORKSPACE),
        (HERE._replace(z=HERE.z + 3.1e-3), Trip.STEP),
        (HERE._replace(y=2.5e-3), Trip.SPEED),
        (HERE._replace(theta=0.018), Trip.STEP),
    ],
)
def test_a_set_point_beyond_a_limit_is_refused(guard, setpoint, trip):
    with pytest.raises(GuardTrip) as caught:
        guard.check_setpoint(setpoint, HERE)
    assert caught.value.trip is trip


def test_the_step_is_measured_from_the_set_point_that_was_sent(guard):
    sent = HERE
    for _ in range(10):
        sent = sent.moved(dx=2e-3)
        guard.check_setpoint(sent, HERE)


def test_a_refused_set_point_does_not_count_as_sent(guard):
    guard.check_setpoint(HERE, HERE)
    with pytest.raises(GuardTrip):
        guard.check_setpoint(HERE.moved(dx=5e-3), HERE)
    with pytest.raises(GuardTrip):
        guard.check_setpoint(HERE.moved(dx=5e-3), HERE)


def test_a_wider_bound_lets_a_stopped_arm_leave():
    wide = Limits().relaxed(2.0)
    Guard(wide, PERIOD).check(cycle((2.9, 0.0, 0.0, 0.0, 0.0, 0.0)))
    with pytest.raises(GuardTrip):
        Guard(wide, PERIOD).check(cycle((3.1, 0.0, 0.0, 0.0, 0.0, 0.0)))
    assert replace(wide, force_bound=Limits().force_bound) == Limits()


def test_an_arm_that_falls_behind_its_set_points_is_stopped(guard):
    place = HERE
    for _ in range(24):  # 48 mm at 0.25 m/s
        place = place._replace(x=place.x + 2e-3)
        guard.check_setpoint(place, HERE)
    guard.check(cycle())
    for ahead in (2e-3, 4e-3):
        guard.check_setpoint(place._replace(x=place.x + ahead), HERE)
    with pytest.raises(GuardTrip, match="following error") as caught:
        guard.check(cycle())
    assert caught.value.trip is Trip.FOLLOWING
