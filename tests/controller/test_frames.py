from math import cos, hypot, pi, remainder, sin, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.frames import TaskFrame, tilt, wrench_to_task
from controller.place import Place

length = st.floats(-0.5, 0.5)
angle = st.floats(-3.1, 3.1)
force = st.floats(-100, 100)


def rotated(rotation_vector, v):
    """Rodrigues' formula."""
    a = hypot(*rotation_vector)
    k = [r / a for r in rotation_vector]
    cross = [k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2], k[0] * v[1] - k[1] * v[0]]
    dot = sum(x * y for x, y in zip(k, v, strict=True))
    return [v[i] * cos(a) + cross[i] * sin(a) + k[i] * dot * (1 - cos(a)) for i in range(3)]


@given(st.tuples(length, length, length), angle, length, length, length, angle)
def test_from_base_inverts_to_base(position, rotation, x, y, z, theta):
    frame = TaskFrame(position, rotation)
    back = frame.from_base(frame.to_base(Place(x, y, z, theta)))
    assert back[:3] == pytest.approx((x, y, z), abs=1e-12)
    assert remainder(back.theta - theta, tau) == pytest.approx(0.0, abs=1e-12)


@given(angle, angle)
def test_the_tool_points_down_whatever_theta(rotation, theta):
    pose = TaskFrame((0.4, 0.0, 0.1), rotation).to_base(Place(0.0, 0.0, 0.0, theta))
    assert rotated(pose[3:], (0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, -1.0), abs=1e-9)
    assert tilt(pose) == pytest.approx(0.0, abs=1e-7)


@given(angle, angle)
def test_both_rotation_vectors_of_one_pose_give_one_theta(rotation, theta):
    frame = TaskFrame((0.4, 0.0, 0.1), rotation)
    pose = frame.to_base(Place(0.0, 0.0, 0.0, theta))
    other = (*pose[:3], -pose[3], -pose[4], -pose[5])
    turn = frame.from_base(pose).theta - frame.from_base(other).theta
    assert remainder(turn, tau) == pytest.approx(0.0, abs=1e-12)


@given(angle, st.tuples(force, force, force))
def test_a_push_turns_as_the_tool_does(theta, push):
    """Sensor axes expressed in task axes by the tool's own pose, the long way round."""
    pose = TaskFrame((0.0, 0.0, 0.0)).to_base(Place(0.0, 0.0, 0.0, theta))
    expected = rotated(pose[3:], push)
    assert wrench_to_task((*push, 0.0, 0.0, 0.0), theta)[:3] == pytest.approx(expected, abs=1e-9)


def test_the_face_pushing_the_tool_up_is_positive_z():
    assert wrench_to_task((0.0, 0.0, -5.0, 0.0, 0.0, 0.0), 0.3)[2] == 5.0


def test_the_moment_about_the_tools_axis_ignores_theta():
    assert wrench_to_task((0.0, 0.0, 0.0, 0.1, 0.2, 0.3), 1.0)[5] == -0.3


def test_a_horizontal_tool_is_a_quarter_turn_off():
    assert tilt((0.0, 0.0, 0.0, pi / 2, 0.0, 0.0)) == pytest.approx(pi / 2)
