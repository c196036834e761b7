from itertools import pairwise
from math import hypot, pi

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


def speeds(robot):
    way = [(0.0,) * 6, *(s for s in robot.setpoints if s is not None)]
    return [
        tuple((b - a) / PERIOD for a, b in zip(before, after, strict=True))
        for before, after in pairwise(way)
    ]


def test_a_blend_on_a_straight_line_keeps_the_speed(robot, run):
    run(
        "movel(p[0.2, 0, 0, 0, 0, 0], a = 1, v = 0.2, r = 0.05)\n"
        "movel(p[0.4, 0, 0, 0, 0, 0], a = 1, v = 0.2)"
    )
    along_x = [v[0] for v in speeds(robot)]
    assert robot.q[0] == pytest.approx(0.4)
    assert max(along_x) <= 0.2 + 1.0 * PERIOD + 1e-6  # the two ramps fit to a cycle
    assert min(along_x[30:-30]) > 0.18


def test_a_blend_rounds_the_corner_within_its_radius(robot, run):
    run(
        "movel(p[0.2, 0, 0, 0, 0, 0], a = 1, v = 0.2, r = 0.03)\n"
        "movel(p[0.2, 0.2, 0, 0, 0, 0], a = 1, v = 0.2)"
    )
    corner = min(hypot(s[0] - 0.2, s[1]) for s in robot.setpoints if s)
    assert 0.001 < corner < 0.03
    assert robot.q[:2] == pytest.approx((0.2, 0.2))
    slowest = min(hypot(v[0], v[1]) for v in speeds(robot)[30:-30])
    assert slowest > 0.1


def test_a_blend_with_nothing_after_it_still_arrives(robot, run):
    run("movej([0.5, 0, 0, 0, 0, 0], a = 2, v = 0.8, r = 0.1)\nsleep(1)")
    assert robot.q[0] == pytest.approx(0.5)


def test_movec_keeps_to_the_circle_and_its_speed(robot, run):
    robot.q = (0.1, 0.0, 0.0, 0.0, 0.0, 0.0)
    run("movec(p[0, 0.1, 0, 0, 0, 0], p[-0.1, 0, 0, 0, 0, 0.4], a = 1, v = 0.1)")
    points = [s for s in robot.setpoints if s]
    assert all(hypot(s[0], s[1]) == pytest.approx(0.1) for s in points)
    assert all(s[1] > -1e-9 for s in points)
    assert robot.q == pytest.approx((-0.1, 0, 0, 0, 0, 0.4))


def test_movec_with_mode_1_turns_the_tool_with_the_circle(robot, run):
    robot.q = (0.1, 0.0, 0.0, 0.0, 0.0, 0.0)
    run("movec(p[0, 0.1, 0, 0, 0, 0], p[-0.1, 0, 0, 0, 0, 0], mode = 1)")
    middle = min((s for s in robot.setpoints if s), key=lambda s: abs(s[0]))
    assert middle[5] == pytest.approx(pi / 2, abs=0.05)


def test_movec_on_a_line_is_refused(run):
    runtime = run("movec(p[0.1, 0, 0, 0, 0, 0], p[0.2, 0, 0, 0, 0, 0])")
    assert "lie on one line" in runtime.error.message


def test_a_longer_look_ahead_lets_servoj_lag(robot, run):
    run("i = 0\nwhile i < 100:\nservoj([i * 0.001, 0, 0, 0, 0, 0], t = 0.008)\ni = i + 1\nend")
    # A first-order lag of 70 ms trails a ramp of 0.125 rad/s by 8.75 mrad, less one cycle.
    assert 0.099 - robot.q[0] == pytest.approx(0.125 * 0.07, rel=0.1)


def test_servoc_arrives_without_slowing_down_and_stays(robot, run):
    run("i = 0\nwhile i < 3:\nservoc(p[0.1, 0, 0, 0, 0, 0], a = 1, v = 0.1)\ni = i + 1\nend")
    assert robot.q[0] == pytest.approx(0.1)
    assert max(v[0] for v in speeds(robot)) == pytest.approx(0.1)
