"""Why the safety system refuses a set-point."""

import math

import pytest

from hil.cell.arm.safety import ForceGuard, Motion, judge
from hil.cell.rig.robot import Safety

LIMITS = Safety()
HOME = (0.0, -1.5, 1.5, -1.5, -1.5, 0.0)
HERE = (0.4, 0.0, 0.2)


def motion(step=0.0, travel=0.0, seconds=0.008, q=HOME):
    after = (q[0] + step, *q[1:])
    return Motion(q, after, HERE, (HERE[0] + travel, *HERE[1:]), seconds)


def test_a_slow_motion_is_allowed():
    assert judge(motion(step=0.02, travel=0.007), LIMITS) is None


@pytest.mark.parametrize(
    ("refused", "why"),
    [
        (motion(step=math.nan), "not finite"),
        (motion(step=0.051), "set-point jump 0.051 rad, allowed is 0.05 rad"),
        (motion(step=0.0252), "joint speed 3.15 rad/s, allowed is 3.142 rad/s"),
        (motion(travel=0.0081), "TCP speed 1.012 m/s, allowed is 1 m/s"),
        (motion(step=0.001, q=(6.283, *HOME[1:])), "joint position"),
    ],
)
def test_a_motion_beyond_a_limit_is_refused_with_the_numbers(refused, why):
    assert why in str(judge(refused, LIMITS))


def test_a_joint_that_braked_beyond_its_range_may_come_back_but_not_stay_out():
    outside = (6.31, *HOME[1:])
    assert judge(motion(step=-0.001, q=outside), LIMITS) is None
    assert judge(motion(step=0.001, q=outside), LIMITS) is not None


def test_too_hard_a_press_stops_once_and_again_only_when_it_grows_or_comes_back():
    guard = ForceGuard(250.0)
    pressed = lambda force: guard.judge((0.0, 0.0, force, 99.0, 0.0, 0.0))  # noqa: E731
    assert pressed(249.0) is None
    assert pressed(-260.0) == "TCP force 260 N, allowed is 250 N"
    assert [pressed(force) for force in (-260.0, -280.0, -255.0)] == [None] * 3  # drives away
    assert pressed(-290.0) is not None
    assert pressed(0.0) is None
    assert pressed(251.0) is not None
