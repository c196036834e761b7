"""How motion builtins reach the arm: one thread a cycle, and nobody while a hand guides it."""

from collections.abc import Callable, Sequence
from math import dist

from hil.cell.arm.port import RobotPort
from hil.cell.arm.pose import Vector6
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Blocking


class Drive:
    """`waypoint` is the TCP pose, m and rad, that the last move aims at; None before the first."""

    __slots__ = ("_claim", "port", "waypoint")

    def __init__(self, port: RobotPort, claim: Callable[[], None]) -> None:
        self.port = port
        self._claim = claim
        self.waypoint: Vector6 | None = None

    @property
    def period(self) -> float:
        """Control period, s."""
        return self.port.period * 1e-9

    def claim(self) -> None:
        """Take the arm for this cycle."""
        if self.port.force.freedrive:
            raise ScriptError("the arm cannot move in freedrive")
        self._claim()

    def to(self, q: Vector6) -> None:
        """Command joint angles, rad."""
        self.claim()
        self.port.servo_q(q)

    def use_of_limits(self, before: Vector6, after: Vector6) -> float:
        """Part of the safety system's speeds that this cycle's way takes; above 1 it would stop."""
        joints, tcp = self.port.speed_limits()
        turn = max(abs(b - a) for a, b in zip(before, after, strict=True))
        way = dist(self.forward(before)[:3], self.forward(after)[:3])
        return max(turn / joints, way / tcp) / self.period

    def brake(self, deceleration: float) -> Blocking:
        """Slow the joints at `deceleration`, rad/s², until they stand."""
        if deceleration <= 0.0:
            raise ScriptError(f"deceleration {deceleration} must be above 0")
        stands = False
        while not stands:
            self._claim()
            stands = self.port.brake(deceleration)
            yield

    def forward(self, q: Vector6) -> Vector6:
        return self.port.forward_kin(q, None)

    def inverse(self, pose: Vector6, near: Sequence[float] | None) -> Vector6:
        """Joint angles of a TCP pose, nearest to `near` or to the target."""
        try:
            return self.port.inverse_kin(pose, near, None)
        except ValueError as error:
            raise ScriptError(f"inverse kinematics: {error}") from error


def along(start: Vector6, goal: Vector6, fraction: float) -> Vector6:
    """`fraction` of the straight way."""
    a, b, c, d, e, f = (p + (q - p) * fraction for p, q in zip(start, goal, strict=True))
    return (a, b, c, d, e, f)
