import pytest

from hil.cell.arm.urscript import RuntimeStatus

PERIOD = 0.008


def test_speedj_speeds_up_by_no_more_than_the_acceleration(robot, run):
    run("speedj([0.1, 0.05, 0, 0, 0, 0], a = 0.5)")
    assert len(robot.setpoints) == pytest.approx(0.1 / 0.5 / PERIOD + 1, abs=1)
    assert robot.q[0] == pytest.approx(0.5 * 0.1**2 / 0.5, rel=0.05)
    assert robot.q[1] == pytest.approx(robot.q[0] / 2)


def test_speedj_with_a_time_ends_then(robot, run):
    run("speedj([1, 0, 0, 0, 0, 0], a = 0.5, t = 0.08)")
    assert sum(s is not None for s in robot.setpoints) == 10


def test_speed_goes_on_from_call_to_call(robot, run):
    run("i = 0\nwhile i < 50:\n  speedj([0.1, 0, 0, 0, 0, 0], 0.5, 0.008)\n  i = i + 1\nend")
    (last,) = [s[0] for s in robot.setpoints[49:50]]
    before = robot.setpoints[48][0]
    assert (last - before) / PERIOD == pytest.approx(0.1)


def test_speedl_reaches_its_twist_in_the_base_frame(robot, run):
    run("i = 0\nwhile i < 100:\nspeedl([0.02, 0, -0.04, 0, 0, 0], 0.4, 0.008)\ni = i + 1\nend")
    before, last = robot.setpoints[98:100]
    assert (last[0] - before[0]) / PERIOD == pytest.approx(0.02)
    assert (last[2] - before[2]) / PERIOD == pytest.approx(-0.04)


@pytest.mark.parametrize("stop", ["stopj(2.0)", "stopl(2.0)"])
def test_stop_brings_the_joints_to_rest(robot, run, stop):
    runtime = run(f"speedj([0.2, 0, 0, 0, 0, 0], 1.0)\n{stop}")
    assert runtime.status is RuntimeStatus.FINISHED
    moving = [s for s in robot.setpoints if s is not None]
    assert moving[-1] == pytest.approx(moving[-2])
    braking = 0.2 / 2.0 / PERIOD
    assert len(moving) == pytest.approx(0.2 / 1.0 / PERIOD + braking, abs=4)
