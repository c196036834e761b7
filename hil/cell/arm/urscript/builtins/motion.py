"""Builtins that move along a path: servoj, movej, movel, movep."""

from collections.abc import Callable
from math import hypot
from typing import Final

from hil.cell.arm import pose as rigid
from hil.cell.arm.port import RobotPort
from hil.cell.arm.pose import Vector6
from hil.cell.arm.urscript.builtins.poses import between
from hil.cell.arm.urscript.builtins.timing import cycles
from hil.cell.arm.urscript.builtins.trapezoid import Trapezoid, lasting, limited
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Blocking, Pose, Value, number, pose6, vector6

_CB3_PERIOD: Final = 0.008


class Motion:
    """Set-points go straight to the servo: blends, `lookahead_time` and `gain` are not modelled."""

    def __init__(self, port: RobotPort, claim: Callable[[], None]) -> None:
        self._port = port
        self._claim = claim

    def servoj(  # noqa: PLR0917  # the manual's order
        self,
        q: Value,
        a: Value = 0.0,
        v: Value = 0.0,
        t: Value = _CB3_PERIOD,
        lookahead_time: Value = 0.1,
        gain: Value = 300.0,
    ) -> Blocking:
        """Be at q (rad) after t (s); when that is several cycles, in equal steps."""
        goal = vector6(q)
        count = cycles(self._port, number(t))
        if count == 1:
            self._command(goal)
            yield
            return
        start = self._port.target_q()
        for i in range(1, count + 1):
            self._command(_along(start, goal, i / count))
            yield

    def movej(
        self, q: Value, a: Value = 1.4, v: Value = 1.05, t: Value = 0.0, r: Value = 0.0
    ) -> Blocking:
        """To joints or a pose; a (rad/s^2) and v (rad/s) hold for the joint that goes farthest."""
        start = self._port.target_q()
        goal = self._inverse(pose6(q), start) if isinstance(q, Pose) else vector6(q)
        way = max(abs(b - a) for a, b in zip(start, goal, strict=True))
        profile = _profile(way, v, a, t)
        yield from self._follow(profile, lambda fraction: _along(start, goal, fraction))

    def movel(
        self, pose: Value, a: Value = 1.2, v: Value = 0.25, t: Value = 0.0, r: Value = 0.0
    ) -> Blocking:
        """On a straight line of the TCP; a and v hold for m or rad, whichever is more."""
        start = self._port.target_tcp_pose()
        goal = pose6(pose) if isinstance(pose, Pose) else self._forward(vector6(pose))
        profile = _profile(_way(start, goal), v, a, t)
        near = self._port.target_q()

        def joints(fraction: float) -> Vector6:
            nonlocal near
            near = self._inverse(between(start, goal, fraction), near)
            return near

        yield from self._follow(profile, joints)

    def movep(self, pose: Value, a: Value = 1.2, v: Value = 0.25, r: Value = 0.0) -> Blocking:
        """As movel: without blends the two are the same."""
        yield from self.movel(pose, a, v)

    def _follow(self, profile: Trapezoid, q_at: Callable[[float], Vector6]) -> Blocking:
        count = cycles(self._port, profile.duration)
        for i in range(1, count):
            self._command(q_at(profile.fraction(i * self._port.period * 1e-9)))
            yield
        self._command(q_at(1.0))
        yield

    def _command(self, q: Vector6) -> None:
        self._claim()
        self._port.servo_q(q)

    def _forward(self, q: Vector6) -> Vector6:
        return self._port.forward_kin(q, None)

    def _inverse(self, pose: Vector6, near: Vector6) -> Vector6:
        try:
            return self._port.inverse_kin(pose, near, None)
        except ValueError as error:
            raise ScriptError(f"inverse kinematics: {error}") from error


def _profile(way: float, v: Value, a: Value, t: Value) -> Trapezoid:
    if number(t) > 0.0:
        return lasting(number(t))
    if not (number(v) > 0.0 and number(a) > 0.0):
        raise ScriptError(f"speed {number(v)} and acceleration {number(a)} must be above 0")
    return limited(way, number(v), number(a))


def _along(start: Vector6, goal: Vector6, fraction: float) -> Vector6:
    a, b, c, d, e, f = (p + (q - p) * fraction for p, q in zip(start, goal, strict=True))
    return (a, b, c, d, e, f)


def _way(start: Vector6, goal: Vector6) -> float:
    """The longer of the distance (m) and the turn (rad)."""
    x, y, z, rx, ry, rz = rigid.twist_between(rigid.of(start), rigid.of(goal), 1.0)
    return max(hypot(x, y, z), hypot(rx, ry, rz))
