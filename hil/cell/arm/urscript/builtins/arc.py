"""The circle of movec: from where the TCP is, through a point, to a pose."""

from math import atan2, hypot, pi
from typing import Final, NamedTuple

from hil.cell.arm import pose as rigid
from hil.cell.arm.pose import Pose, Vector3, Vector6, product, rotation_of, shifted, turn
from hil.cell.arm.urscript.errors import ScriptError

_THIN: Final = 1e-9
"""m², of the square of a distance: nearer than 30 um three points make no circle."""


class Arc(NamedTuple):
    """centre: m. axis: of unit length. angle: rad, above 0. All in the base frame."""

    start: Pose
    centre: Vector3
    axis: Vector3
    angle: float
    turn: Vector3
    fixed: bool

    @property
    def length(self) -> float:
        """In m."""
        return hypot(*_minus(self.start.position, self.centre)) * self.angle

    def pose(self, fraction: float) -> Vector6:
        """TCP pose at that part of the way."""
        x, y, z = self.axis
        angle = self.angle * fraction
        about = rotation_of(x * angle, y * angle, z * angle)
        arm = turn(about, _minus(self.start.position, self.centre))
        rx, ry, rz = (r * fraction for r in self.turn)
        turned = about if self.fixed else rotation_of(rx, ry, rz)
        moved = Pose(self.centre, product(turned, self.start.rotation))
        return rigid.vector_of(shifted(moved, arm))


def arc(start: Vector6, via: Vector6, goal: Vector6, *, fixed: bool) -> Arc:
    """The arc over three positions; `fixed` keeps the tool's angle to the circle.

    Otherwise the tool turns from its orientation at the start to the goal's.
    """
    a, b, c = start[:3], via[:3], goal[:3]
    u, v = _minus(b, a), _minus(c, a)
    normal = _cross(u, v)
    square = _dot(normal, normal)
    if square <= _THIN * max(_dot(u, u), _dot(v, v)):
        raise ScriptError("the three points of movec lie on one line")
    uu, vv = _dot(u, u), _dot(v, v)
    centre = _plus(a, _scaled(_cross(_minus(_scaled(v, uu), _scaled(u, vv)), normal), 0.5 / square))
    axis = _scaled(normal, 1.0 / square**0.5)
    first, last = _minus(a, centre), _minus(c, centre)
    angle = atan2(_dot(axis, _cross(first, last)), _dot(first, last)) % (2.0 * pi)
    begin, end = rigid.of(start), rigid.of(goal)
    _, _, _, rx, ry, rz = rigid.twist_between(begin, end, 1.0)
    return Arc(begin, centre, axis, angle, (rx, ry, rz), fixed)


def _minus(a: Vector3, b: Vector3) -> Vector3:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _plus(a: Vector3, b: Vector3) -> Vector3:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def _scaled(a: Vector3, k: float) -> Vector3:
    return (a[0] * k, a[1] * k, a[2] * k)


def _dot(a: Vector3, b: Vector3) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector3, b: Vector3) -> Vector3:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
