"""Builtins that read the robot's state."""

from typing import Final

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript.values import List, Pose, Value, vector6

_STEP: Final = 1e-3
"""s over which a Jacobian is differentiated."""

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

    def get_target_tcp_speed(self) -> List:
        return List(self._port.target_tcp_speed())

    # Conveyor tracking and path offsets would tell them apart; there are none here.
    get_target_tcp_pose_along_path = get_target_tcp_pose
    get_target_tcp_speed_along_path = get_target_tcp_speed

    def get_target_joint_accelerations(self) -> List:
        return List(self._port.target_qdd())

    def get_joint_torques(self) -> List:
        """N·m, of contact alone."""
        return List(self._port.joint_torques())

    def get_jacobian(self, q: Value = "current") -> List:
        joints = self._port.actual_q() if q == "current" else vector6(q)
        return List(map(List, self._port.jacobian(joints)))

    def get_jacobian_time_derivative(self, q: Value = "current", qd: Value = "current") -> List:
        """Along the motion qd, by differences."""
        joints = self._port.actual_q() if q == "current" else vector6(q)
        speeds = self._port.actual_qd() if qd == "current" else vector6(qd)
        before, after = (
            self._port.jacobian([a + k * v for a, v in zip(joints, speeds, strict=True)])
            for k in (-_STEP, _STEP)
        )
        rows = zip(before, after, strict=True)
        return List(List((b - a) / (2 * _STEP) for a, b in zip(*row, strict=True)) for row in rows)

    def get_tcp_offset(self) -> Pose:
        return Pose(self._port.tcp_offset())

    def is_steady(self) -> bool:
        return all(abs(speed) < STEADY for speed in self._port.actual_qd())
