import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.arm.urscript.builtins.poses import Poses
from hil.cell.arm.urscript.values import List, Pose

axis = st.floats(-1.5, 1.5)
poses = st.tuples(axis, axis, axis, axis, axis, axis).map(Pose)
ORIGIN = Pose((0.0,) * 6)


@given(poses)
def test_pose_times_its_inverse_is_the_origin(pose):
    assert Poses.pose_trans(pose, Poses.pose_inv(pose)) == pytest.approx(ORIGIN, abs=1e-9)


@given(poses, poses)
def test_pose_sub_undoes_pose_add_from_the_origin(a, b):
    moved = Poses.pose_add(Poses.pose_sub(a, b), b)
    assert Poses.pose_dist(moved, a) == pytest.approx(0.0, abs=1e-9)
    assert Poses.pose_sub(moved, a) == pytest.approx(ORIGIN, abs=1e-6)


@given(poses, poses)
def test_interpolation_ends_at_its_ends(a, b):
    for alpha, end in ((0.0, a), (1.0, b)):
        reached = Poses.interpolate_pose(a, b, alpha)
        assert Poses.pose_sub(reached, end) == pytest.approx(ORIGIN, abs=1e-6)


@given(axis, axis, axis)
def test_roll_pitch_yaw_survive_the_rotation_vector(roll, pitch, yaw):
    there = Poses.rpy2rotvec(List((roll, pitch, yaw)))
    assert Poses.rotvec2rpy(there) == pytest.approx((roll, pitch, yaw), abs=1e-6)


def test_pose_trans_turns_the_second_pose():
    quarter = Pose((1.0, 0.0, 0.0, 0.0, 0.0, math.pi / 2))
    step = Pose((1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert Poses.pose_trans(quarter, step) == pytest.approx((1, 1, 0, 0, 0, math.pi / 2))
