import pytest

from controller.course import Course
from controller.guard import Limits
from controller.outcome import Ending, Kind
from drivers.errors import LinkError, ProtectiveStopError, StaleSampleError

DONE = Ending(Kind.DONE, "enough")


def stay(cycles):
    def job(course: Course):
        course.name = "stay"
        for _ in range(cycles):
            yield from course.to(course.setpoint)
        return DONE

    return job


def climb(course: Course):
    """Fast enough for a stop to take time."""
    for _ in range(1000):
        yield from course.to(course.setpoint.moved(dz=1e-3))
    return DONE


def test_a_job_that_ends_is_reported_with_its_cycles(make_cell):
    outcome = make_cell().loop.run(stay(20), Limits())
    assert (outcome.kind, outcome.reason) == (Kind.DONE, "enough")
    assert outcome.cycles == 21
    assert outcome.misses == 0
    assert outcome.standstill is None


def test_one_run_can_follow_another(make_cell):
    cell = make_cell()
    assert [cell.loop.run(stay(3), Limits()).kind for _ in range(3)] == [Kind.DONE] * 3


def test_every_cycle_with_a_set_point_is_observed(make_cell):
    cell = make_cell()
    cell.loop.run(stay(5), Limits())
    assert [phase for _, _, phase in cell.seen] == ["stay"] * 5
    seen = [list(setpoint) for _, setpoint, _ in cell.seen]
    assert seen[-1] == pytest.approx(list(cell.arm.sent[-1]))
    assert len(cell.arm.sent) == 5


@pytest.mark.parametrize("error", [StaleSampleError("12 ms old"), LinkError("bus is off")])
def test_a_failing_sensor_stops_the_arm_within_the_same_cycle(make_cell, error):
    cell = make_cell()
    cell.sensor.faults[10] = error
    outcome = cell.loop.run(climb, Limits())
    assert outcome.kind is Kind.FAULT
    assert str(error) in outcome.reason
    assert len(cell.arm.sent) == 9
    assert outcome.standstill is True
    assert max(map(abs, cell.world.velocity)) < 1e-3


def test_a_protective_stop_ends_the_run_and_says_so(make_cell):
    cell = make_cell()
    cell.arm.faults = {n: ProtectiveStopError("protective stop") for n in range(10, 1000)}
    outcome = cell.loop.run(stay(100), Limits())
    assert outcome.kind is Kind.FAULT
    assert outcome.reason == "ProtectiveStopError: protective stop"
    assert outcome.standstill is False


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_force_beyond_the_bound_is_danger_and_stops_within_one_cycle(make_cell, axis):
    cell = make_cell()
    push = [0.0] * 6
    push[axis] = 30.0

    def job(course: Course):
        for cycle in range(100):
            if cycle == 10:
                cell.world.extra = tuple(push)
            yield from course.to(course.setpoint)
        return DONE

    outcome = cell.loop.run(job, Limits())
    assert outcome.kind is Kind.DANGER
    assert "force" in outcome.reason
    assert len(cell.arm.sent) == 11


def test_a_phase_that_jumps_is_stopped_before_anything_is_sent(make_cell):
    cell = make_cell()

    def job(course: Course):
        yield from course.to(course.setpoint.moved(dx=0.02))
        return DONE

    outcome = cell.loop.run(job, Limits())
    assert outcome.kind is Kind.FAULT
    assert cell.arm.sent == []
    assert cell.arm.stops > 0


def test_periods_that_the_arms_clock_skips_are_counted(make_cell):
    cell = make_cell()
    cell.arm.skips = {5: 2, 9: 1}
    assert cell.loop.run(stay(20), Limits()).misses == 3


@pytest.mark.parametrize("error", [KeyboardInterrupt(), ZeroDivisionError("a bug")])
def test_anything_else_stops_the_arm_and_goes_on(make_cell, error):
    cell = make_cell()

    def job(course: Course):
        yield from course.to(course.setpoint)
        raise error

    with pytest.raises(type(error)):
        cell.loop.run(job, Limits())
    assert cell.arm.stops == 1
