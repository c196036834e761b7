"""Builtins that command a speed: speedj, speedl, stopj, stopl."""

from math import hypot
from typing import Final

from hil.cell.arm import pose as rigid
from hil.cell.arm.pose import ZERO6, Vector6
from hil.cell.arm.urscript.builtins.drive import Drive
from hil.cell.arm.urscript.builtins.timing import cycles
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Blocking, Value, number, vector6

_AT_REST: Final = 1e-4
"""m/s under which a TCP speed says nothing about how joints and TCP relate."""


class Speed:
    """Speeds go on from the last cycle's and change by no more than the acceleration allows."""

    def __init__(self, drive: Drive) -> None:
        self._drive = drive
        self._port = drive.port
        self._twist = ZERO6
        self._twist_end = -1

    def speedj(self, qd: Value, a: Value = 0.5, t: Value = 0.0) -> Blocking:
        """rad/s and rad/s^2; ends after t (s), or when the speed is reached if t is 0."""
        goal = vector6(qd)
        left = cycles(self._port, number(t)) if number(t) > 0.0 else -1
        speed = self._port.target_qd()
        while left != 0:
            speed = _approach(speed, goal, number(a) * self._drive.period)
            self._drive.to(_moved(self._port.target_q(), speed, self._drive.period))
            yield
            left = 0 if left < 0 and speed == goal else left - 1

    def speedl(self, xd: Value, a: Value = 0.5, t: Value = 0.0, aRot: Value = "a") -> Blocking:
        """m/s, rad/s and m/s^2 (rad/s^2) in the base frame; ends as speedj does."""
        goal = vector6(xd)
        left = cycles(self._port, number(t)) if number(t) > 0.0 else -1
        speed = self._twist if self._twist_end == self._port.t else ZERO6
        while left != 0:
            speed = _approach(speed, goal, number(a) * self._drive.period)
            self._drive.to(self._joints(speed))
            self._twist, self._twist_end = speed, self._port.t + self._port.period
            yield
            left = 0 if left < 0 and speed == goal else left - 1

    def stopj(self, a: Value = 2.0) -> Blocking:
        """Slow the joints at a (rad/s^2) until they stand."""
        yield from self._drive.brake(number(a))

    def stopl(self, a: Value = 20.0, aRot: Value = "a") -> Blocking:
        """Slow the TCP at a (m/s^2): all joints slow together, in the ratio they move now.

        By targets throughout: the arm itself still moves when its target stands already.
        """
        x, y, z, *_ = self._port.target_tcp_speed()
        tcp = hypot(x, y, z)
        joints = max(abs(v) for v in self._port.target_qd())
        ratio = joints / tcp if tcp > _AT_REST else 1.0
        yield from self._drive.brake(number(a) * ratio)

    def _joints(self, twist: Vector6) -> Vector6:
        """The joint set-point one period of `twist` away from the target pose."""
        x, y, z, rx, ry, rz = (v * self._drive.period for v in twist)
        now = rigid.of(self._port.target_tcp_pose())
        turned = rigid.product(rigid.rotation_of(rx, ry, rz), now.rotation)
        after = rigid.vector_of(rigid.shifted(rigid.Pose(now.position, turned), (x, y, z)))
        return self._drive.inverse(after, None)


def _approach(speed: Vector6, goal: Vector6, step: float) -> Vector6:
    """`goal`, or as near to it as the fastest changing component gets by `step`."""
    if step <= 0.0:
        raise ScriptError("acceleration must be above 0")
    change = max(abs(g - s) for s, g in zip(speed, goal, strict=True))
    return goal if change <= step else _moved(speed, _difference(goal, speed), step / change)


def _difference(a: Vector6, b: Vector6) -> Vector6:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5])


def _moved(start: Vector6, rate: Vector6, factor: float) -> Vector6:
    a, b, c, d, e, f = (p + r * factor for p, r in zip(start, rate, strict=True))
    return (a, b, c, d, e, f)
