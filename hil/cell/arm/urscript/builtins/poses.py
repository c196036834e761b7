"""Builtins of pose algebra; the equations are the Script Manual's."""

import math

from hil.cell.arm import pose as rigid
from hil.cell.arm.urscript.values import List, Pose, Value, number, pose6, sequence


class Poses:
    @staticmethod
    def pose_trans(p_from: Value, p_from_to: Value) -> Pose:
        """p_from * p_from_to, as transforms."""
        return _pose(rigid.compose(_rigid(p_from), _rigid(p_from_to)))

    @staticmethod
    def pose_inv(p_from: Value) -> Pose:
        return _pose(rigid.inverse(_rigid(p_from)))

    @staticmethod
    def pose_add(p_1: Value, p_2: Value) -> Pose:
        """Positions add; the rotation is R1 * R2."""
        a, b = _rigid(p_1), _rigid(p_2)
        turned = rigid.Pose(a.position, rigid.product(a.rotation, b.rotation))
        return _pose(rigid.shifted(turned, b.position))

    @staticmethod
    def pose_sub(p_to: Value, p_from: Value) -> Pose:
        """Positions subtract; the rotation is R_to * R_from^-1, both in the base's axes."""
        return Pose(rigid.twist_between(_rigid(p_from), _rigid(p_to), 1.0))

    @staticmethod
    def pose_dist(p_from: Value, p_to: Value) -> float:
        """Distance of the positions, m."""
        return Poses.point_dist(p_from, p_to)

    @staticmethod
    def point_dist(p_from: Value, p_to: Value) -> float:
        """Distance of the positions, m."""
        return math.dist(_rigid(p_from).position, _rigid(p_to).position)

    @staticmethod
    def interpolate_pose(p_from: Value, p_to: Value, alpha: Value) -> Pose:
        """Position and rotation go along straight lines; alpha 0 is p_from, 1 is p_to."""
        start = pose6(p_from)
        return Pose(between(start, pose6(p_to), number(alpha)))

    @staticmethod
    def rpy2rotvec(rpy: Value) -> List:
        """Roll, pitch, yaw about the fixed X, Y, Z axes, rad."""
        roll, pitch, yaw = (number(x) for x in sequence(rpy))
        about_x, about_y = rigid.rotation_of(roll, 0.0, 0.0), rigid.rotation_of(0.0, pitch, 0.0)
        turned = rigid.product(rigid.rotation_of(0.0, 0.0, yaw), rigid.product(about_y, about_x))
        return List(rigid.rotation_vector(turned))

    @staticmethod
    def rotvec2rpy(rotation_vector: Value) -> List:
        """Roll, pitch, yaw about the fixed X, Y, Z axes, rad; pitch is within +-pi/2."""
        rx, ry, rz = (number(x) for x in sequence(rotation_vector))
        (r00, _, _), (r10, _, _), (r20, r21, r22) = rigid.rotation_of(rx, ry, rz)
        pitch = math.atan2(-r20, math.hypot(r00, r10))
        return List((math.atan2(r21, r22), pitch, math.atan2(r10, r00)))


def between(start: rigid.Vector6, goal: rigid.Vector6, fraction: float) -> rigid.Vector6:
    """The pose at `fraction` of the straight way from `start` to `goal`."""
    a, b = rigid.of(start), rigid.of(goal)
    x, y, z, rx, ry, rz = rigid.twist_between(a, b, 1.0)
    turn = rigid.rotation_of(rx * fraction, ry * fraction, rz * fraction)
    moved = rigid.Pose(a.position, rigid.product(turn, a.rotation))
    return rigid.vector_of(rigid.shifted(moved, (x * fraction, y * fraction, z * fraction)))


def _rigid(value: Value) -> rigid.Pose:
    return rigid.of(pose6(value))


def _pose(pose: rigid.Pose) -> Pose:
    return Pose(rigid.vector_of(pose))
