from itertools import pairwise

import pytest

from hil.cell.arm.urscript import RuntimeStatus

PERIOD = 0.008


def first_axis(robot):
    return [setpoint[0] for setpoint in robot.setpoints if setpoint is not None]


def test_servoj_over_several_cycles_arrives_in_equal_steps(robot, run):
    run("servoj([0.4, 0, 0, 0, 0, 0], t = 0.032, lookahead_time = 0.03)")
    assert first_axis(robot) == pytest.approx([0.1, 0.2, 0.3, 0.4])


def test_movej_keeps_speed_and_acceleration_of_the_farthest_joint(robot, run):
    run("movej([1.0, -0.5, 0, 0, 0, 0], a = 2.0, v = 0.8)")
    way = [0.0, *first_axis(robot)]
    speeds = [(b - a) / PERIOD for a, b in pairwise(way)]
    changes = [abs(b - a) / PERIOD for a, b in pairwise(speeds)]
    assert max(speeds) == pytest.approx(0.8)
    assert max(changes) <= 2.0 + 1e-6
    assert robot.q == (1.0, -0.5, 0.0, 0.0, 0.0, 0.0)


def test_movej_moves_all_joints_together(robot, run):
    run("movej([1.0, -0.5, 0, 0, 0, 0])")
    assert all(s[1] == pytest.approx(-0.5 * s[0]) for s in robot.setpoints if s)


def test_movej_with_a_time_takes_that_time(robot, run):
    run("movej([1.0, 0, 0, 0, 0, 0], t = 0.4)")
    assert len(first_axis(robot)) == 50


def test_movel_goes_straight_from_pose_to_pose(robot, run):
    run("movel(p[0.1, 0.2, 0, 0, 0, 0.3], a = 1.2, v = 0.25)")
    assert robot.q == pytest.approx((0.1, 0.2, 0.0, 0.0, 0.0, 0.3))
    for setpoint in filter(None, robot.setpoints):
        assert setpoint[1] == pytest.approx(2 * setpoint[0])
        assert setpoint[5] == pytest.approx(3 * setpoint[0])


def test_move_to_where_the_robot_is_takes_one_cycle(robot, run):
    run("movej([0, 0, 0, 0, 0, 0])")
    assert first_axis(robot) == [0.0]


def test_pose_out_of_reach_ends_the_program(run):
    runtime = run("movel(p[5, 0, 0, 0, 0, 0])")
    assert runtime.error.message == "inverse kinematics: out of reach"


@pytest.mark.parametrize("call", ["movej([1, 0, 0, 0, 0, 0], v = 0)", "stopj(0)", "sleep(-1)"])
def test_impossible_motion_parameters_end_the_program(run, call):
    assert run(call).status is RuntimeStatus.FAILED
