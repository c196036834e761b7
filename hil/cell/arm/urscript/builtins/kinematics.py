"""Builtins of the arm's kinematics."""

from collections.abc import Sequence

from hil.cell.arm.port import RobotPort, Vector6
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import List, Pose, Value, pose6, vector6


class Kinematics:
    """`"current"` and `"active"` stand for arguments left out, as in the manual's signatures."""

    def __init__(self, port: RobotPort) -> None:
        self._port = port

    def get_forward_kin(self, q: Value = "current", tcp: Value = "active") -> Pose:
        joints = self._port.actual_q() if q == "current" else vector6(q)
        return Pose(self._port.forward_kin(joints, _tcp(tcp)))

    def get_inverse_kin(
        self,
        x: Value,
        qnear: Value = "current",
        maxPositionError: Value = 1e-10,
        maxOrientationError: Value = 1e-10,
        tcp: Value = "active",
    ) -> List:
        """The kinematics are analytic, so the error bounds are always kept and not looked at."""
        try:
            return List(self._port.inverse_kin(pose6(x), _near(qnear), _tcp(tcp)))
        except ValueError as error:
            raise ScriptError(f"inverse kinematics: {error}") from error

    def get_inverse_kin_has_solution(
        self,
        pose: Value,
        qnear: Value = "current",
        maxPositionError: Value = 1e-10,
        maxOrientationError: Value = 1e-10,
        tcp: Value = "active",
    ) -> bool:
        try:
            self._port.inverse_kin(pose6(pose), _near(qnear), _tcp(tcp))
        except ValueError:
            return False
        return True

    def is_within_safety_limits(self, position: Value) -> bool:
        """Of a pose, or of joint angles: within reach and joint range; no planes are modelled."""
        if not isinstance(position, Pose):
            return self._port.refusal(vector6(position)) is None
        try:
            q = self._port.inverse_kin(pose6(position), None, None)
        except ValueError:
            return False
        return self._port.refusal(q) is None

    def get_actual_tool_flange_pose(self) -> Pose:
        return Pose(self._port.forward_kin(self._port.actual_q(), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)))


def _near(value: Value) -> Sequence[float] | None:
    return None if value == "current" else vector6(value)


def _tcp(value: Value) -> Vector6 | None:
    return None if value == "active" else pose6(value)
