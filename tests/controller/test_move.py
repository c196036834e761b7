from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.guard import Limits
from controller.outcome import Ending, Kind
from controller.phases.move import move, travelled, via
from controller.place import Place
from controller.settings import Travel

TRAVEL = Travel()


def drive(cell, phase):
    def job(course):
        yield from phase(course)
        return Ending(Kind.DONE, "")

    return cell.loop.run(job, Limits())


@settings(max_examples=30, deadline=None)
@given(
    st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(0.0, 0.2), st.floats(-2.0, 2.0),
    st.sampled_from([125, 500]),
)  # fmt: skip
def test_a_move_arrives_exactly_and_never_faster_than_its_limits(make_cell, x, y, z, theta, rate):
    cell = make_cell(rate=rate)
    target = Place(x, y, z, theta)
    outcome = drive(cell, lambda course: move(course, target, TRAVEL))
    assert outcome.kind is Kind.DONE, outcome.reason
    places = [setpoint for _, setpoint, _ in cell.seen]
    assert places[-1] == target
    for a, b in pairwise(places):
        way = sum((p - q) ** 2 for p, q in zip(a[:3], b[:3], strict=True)) ** 0.5
        assert way <= TRAVEL.speed / rate * 1.001
        assert abs(a.theta - b.theta) <= TRAVEL.turn_speed / rate * 1.001


@given(st.floats(0.1, 10.0), st.floats(0.1, 100.0), st.lists(st.floats(0.0, 30.0), min_size=2))
def test_a_trapezoid_never_goes_back_and_ends_at_one(speed, acceleration, times):
    way = [travelled(t, speed, acceleration) for t in sorted(times)]
    assert all(a <= b + 1e-12 for a, b in pairwise(way))
    assert travelled(1e3, speed, acceleration) == 1.0


def test_crossing_stays_above_the_fixtures(make_cell):
    cell = make_cell(at=(-0.1, 0.0, 0.005, 0.0))
    drive(cell, lambda course: via(course, Place(0.1, 0.0, 0.005, 0.0), TRAVEL))
    crossing = [s.z for _, s, _ in cell.seen if abs(s.x) < 0.099]
    assert min(crossing) == pytest.approx(TRAVEL.height)


def test_a_move_to_where_it_is_takes_one_period(make_cell):
    cell = make_cell()
    drive(cell, lambda course: move(course, course.setpoint, TRAVEL))
    assert len(cell.seen) == 1
