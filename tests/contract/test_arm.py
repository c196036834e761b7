"""What a controller may rely on with any arm: `drivers.interfaces.Arm`."""

from itertools import pairwise, product
from math import dist, inf, nan

import pytest

from drivers.interfaces import RobotMode, SafetyMode

STEP = 50e-6
"""Set-point change of one period, m: slow enough for any of them."""


def shifted(pose, x):
    return (pose[0] + x, *pose[1:])


def approach(subject, pose, periods):
    """Walk along x in steps; the states on the way."""
    steps = iter(range(1, periods + 1))
    return subject.states(periods, lambda: subject.arm.servo(shifted(pose, next(steps) * STEP)))


def test_a_connected_arm_follows_set_points(subject):
    for state in (subject.arm.connect(), subject.arm.read()):
        assert state.robot_mode is RobotMode.RUNNING
        assert state.safety_mode is SafetyMode.NORMAL
        assert state.program_running


def test_each_state_is_one_control_period_after_the_last(subject):
    first = subject.connect()
    states = [first, *subject.states(60, subject.arm.hold)]
    assert {after.t - before.t for before, after in pairwise(states)} == {subject.arm.period}


def test_time_is_whole_nanoseconds(subject):
    subject.connect()
    assert all(type(state.t) is int for state in subject.states(3, subject.arm.hold))


def test_servo_returns_the_pose_it_sent(subject):
    pose = shifted(subject.connect().pose, STEP)
    assert subject.arm.servo(pose) == pose


def test_an_arm_gets_to_where_it_is_sent(subject):
    start = subject.connect().pose
    approach(subject, start, 40)
    state = subject.states(100, subject.arm.hold)[-1]
    assert dist(state.pose[:3], shifted(start, 40 * STEP)[:3]) < 20e-6
    assert dist(state.target_pose[:3], shifted(start, 40 * STEP)[:3]) < 20e-6


def test_an_arm_on_its_way_says_how_fast(subject):
    start = subject.connect().pose
    speed = STEP / subject.arm.period * 1e9
    periods = round(0.4e9 / subject.arm.period)
    # Between two set-points the arm slows down: at a package, 22 Hz behind 125 Hz, by a tenth.
    assert approach(subject, start, periods)[-1].twist[0] == pytest.approx(speed, rel=0.15)


def test_a_set_point_that_is_not_finite_is_refused_and_not_sent(subject):
    start = subject.connect()
    for bad, axis in product((nan, inf, -inf), range(6)):
        pose = [*start.pose]
        pose[axis] = bad
        with pytest.raises(ValueError, match="finite"):
            subject.arm.servo(tuple(pose))
    state = subject.states(5, subject.arm.hold)[-1]
    assert state.t == start.t + 5 * subject.arm.period
    assert dist(state.pose, start.pose) < 20e-6


def test_the_first_hold_keeps_the_arm_where_it_stands(subject):
    start = subject.connect()
    assert dist(subject.arm.hold()[:3], start.pose[:3]) < 20e-6
    subject.arm.read()
    assert dist(subject.states(50, subject.arm.hold)[-1].pose[:3], start.pose[:3]) < 20e-6


def test_a_hold_repeats_the_last_set_point(subject):
    pose = shifted(subject.connect().pose, STEP)
    subject.arm.servo(pose)
    subject.arm.read()
    assert subject.arm.hold() == pytest.approx(pose, abs=1e-9)


def test_stop_brings_a_moving_arm_to_rest_on_its_way(subject):
    start = subject.connect().pose
    approach(subject, start, 200)
    stopping = subject.states(1, subject.arm.stop)
    rest = stopping + subject.states(200, subject.arm.hold)
    assert dist(rest[-1].twist, (0.0,) * 6) < 1e-4
    way = rest[-1].pose[0] - start[0]
    assert 0.5 * 200 * STEP < way < 1.2 * 200 * STEP
    assert dist(rest[-1].pose[:3], rest[-50].pose[:3]) < 5e-6


def test_after_a_stop_servo_goes_on_from_where_the_arm_stands(subject):
    start = subject.connect().pose
    approach(subject, start, 100)
    subject.states(1, subject.arm.stop)
    rest = subject.states(200, subject.arm.hold)[-1].pose
    approach(subject, rest, 40)
    state = subject.states(100, subject.arm.hold)[-1]
    assert dist(state.pose[:3], shifted(rest, 40 * STEP)[:3]) < 20e-6


def test_an_output_is_set_with_the_next_command_and_stays_so(subject):
    subject.connect()
    subject.arm.set_output(3, True)
    assert {state.outputs & 8 for state in subject.states(20, subject.arm.hold)[10:]} == {8}
    subject.arm.set_output(5, True)
    subject.arm.set_output(3, False)
    assert subject.states(20, subject.arm.hold)[-1].outputs & 0b101000 == 0b100000


def test_close_may_come_at_any_time_and_twice(subject):
    subject.arm.close()
    subject.connect()
    subject.arm.close()
    subject.arm.close()


def test_an_arm_that_was_closed_connects_again_and_later(subject):
    before = subject.connect()
    subject.arm.close()
    after = subject.connect()
    assert after.t > before.t
    assert after.program_running
    assert dist(subject.states(5, subject.arm.hold)[-1].pose[:3], before.pose[:3]) < 50e-6
