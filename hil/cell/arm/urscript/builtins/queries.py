"""Builtins that read the robot's state."""

from typing import Final

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript.values import List, Pose

STEADY: Final = 1e-3
"""rad/s below which a joint counts as standing; assumed."""


class Queries:
    """Joints in rad and rad/s, poses in m and rad in the base frame, wrenches in N and N·m."""

    def __init__(self, port: RobotPort) -> None:
        self._port = port

    def get_actual_joint_positions(self) -> List:
        return List(self._port.actual_q())

    get_joint_positions = get_actual_joint_positions  # the old name, which clients still use

    def get_target_joint_positions(self) -> List:
        return List(self._port.target_q())

    def get_actual_joint_speeds(self) -> List:
        return List(self._port.actual_qd())

    def get_target_joint_speeds(self) -> List:
        return List(self._port.target_qd())

    def get_actual_tcp_pose(self) -> Pose:
        return Pose(self._port.actual_tcp_pose())

    def get_target_tcp_pose(self) -> Pose:
        return Pose(self._port.target_tcp_pose())

    def get_actual_tcp_speed(self) -> List:
        return List(self._port.actual_tcp_speed())

    def get_tcp_force(self) -> List:
        return List(self._port.tcp_force())

    def force(self) -> float:
        """Magnitude of the force part of get_tcp_force(), N."""
        x, y, z, *_ = self._port.tcp_force()
        return float((x * x + y * y + z * z) ** 0.5)

    def get_tcp_offset(self) -> Pose:
        return Pose(self._port.tcp_offset())

    def is_steady(self) -> bool:
        return all(abs(speed) < STEADY for speed in self._port.actual_qd())
