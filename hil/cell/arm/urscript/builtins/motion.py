"""Builtins that move along a path: movej, movel, movep, movec and the optimo pair."""

from collections.abc import Callable
from math import dist, hypot
from typing import Final

from hil.cell.arm import pose as rigid
from hil.cell.arm.pose import Vector6
from hil.cell.arm.urscript.builtins.arc import arc
from hil.cell.arm.urscript.builtins.drive import Drive, along
from hil.cell.arm.urscript.builtins.follow import MARGIN, Path, follow
from hil.cell.arm.urscript.builtins.poses import between
from hil.cell.arm.urscript.builtins.trapezoid import Trapezoid, lasting, limited
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Blocking, Pose, Value, integer, number, pose6, vector6

_JOINT_LIMITS: Final = (40.0, 3.14)
_TOOL_LIMITS: Final = (10.0, 1.0)
"""Acceleration and speed that optimovej and optimovel take fractions of, and an acceleration no
given time exceeds; assumed.
"""


class Motion:
    """Speed is trapezoidal, the speed slider slows it, and a blend radius rounds the corner.

    A blended move ends where it slows down within the radius. The next one starts at the corner
    and the rest of the old one is added to it, so that on a straight line the speed stays.
    """

    def __init__(self, drive: Drive) -> None:
        self._drive = drive

    def movej(
        self, q: Value, a: Value = 1.4, v: Value = 1.05, t: Value = 0.0, r: Value = 0.0
    ) -> Blocking:
        """To joints or a pose; a (rad/s^2) and v (rad/s) hold for the joint that goes farthest."""
        start = self._start()
        goal = self._drive.inverse(pose6(q), start) if isinstance(q, Pose) else vector6(q)
        way = max(abs(b - a) for a, b in zip(start, goal, strict=True))
        profile = _profile(way, self._allowed(v, 0), a, t, self._most(0))
        yield from follow(self._drive, self._joint_path(start, goal), profile, number(r))

    def movel(
        self, pose: Value, a: Value = 1.2, v: Value = 0.25, t: Value = 0.0, r: Value = 0.0
    ) -> Blocking:
        """On a straight line of the TCP; a and v hold for m or rad, whichever is more."""
        near = self._start()
        start, goal = self._drive.forward(near), self._pose(pose)
        self._drive.waypoint = goal
        path = self._tool_path(lambda fraction: between(start, goal, fraction), near)
        profile = _profile(_way(start, goal), self._allowed(v, 1), a, t, self._most(1))
        yield from follow(self._drive, Path(path, _distance(start, goal)), profile, number(r))

    def movep(self, pose: Value, a: Value = 1.2, v: Value = 0.25, r: Value = 0.0) -> Blocking:
        """As movel: blends are not circles of constant speed here."""
        yield from self.movel(pose, a, v, 0.0, r)

    def movec(  # noqa: PLR0917  # the manual's order
        self,
        pose_via: Value,
        pose_to: Value,
        a: Value = 1.2,
        v: Value = 0.25,
        r: Value = 0.0,
        mode: Value = 0,
    ) -> Blocking:
        """On a circle; mode 0 turns the tool to pose_to's orientation, 1 along with the circle."""
        near = self._start()
        start, goal = self._drive.forward(near), self._pose(pose_to)
        self._drive.waypoint = goal
        circle = arc(start, self._pose(pose_via), goal, fixed=integer(mode) == 1)
        profile = _profile(circle.length, self._allowed(v, 1), a, 0.0, self._most(1))
        path = Path(self._tool_path(circle.pose, near), circle.length)
        yield from follow(self._drive, path, profile, number(r))

    def optimovej(self, q: Value, a: Value = 0.3, v: Value = 0.3, r: Value = 0.0) -> Blocking:
        """As movej, with fractions of the robot's limits."""
        most_a, most_v = _JOINT_LIMITS
        yield from self.movej(q, number(a) * most_a, number(v) * most_v, 0.0, r)

    def optimovel(self, pose: Value, a: Value = 0.3, v: Value = 0.3, r: Value = 0.0) -> Blocking:
        """As movel, with fractions of the robot's limits."""
        most_a, most_v = _TOOL_LIMITS
        yield from self.movel(pose, number(a) * most_a, number(v) * most_v, 0.0, r)

    def get_target_waypoint(self) -> Pose:
        """The TCP pose that the last move aims at; before any, the target."""
        return Pose(self._drive.waypoint or self._drive.port.target_tcp_pose())

    def _allowed(self, v: Value, limit: int) -> float:
        """The speed asked for, or what the safety system leaves of it; limit: 0 joints, 1 TCP."""
        return min(number(v), MARGIN * self._drive.port.speed_limits()[limit])

    def _most(self, limit: int) -> tuple[float, float]:
        """Acceleration and speed that a move takes at most; limit: 0 joints, 1 TCP."""
        speed = MARGIN * self._drive.port.speed_limits()[limit]
        return (_JOINT_LIMITS, _TOOL_LIMITS)[limit][0], speed

    def _start(self) -> Vector6:
        """Where the next path begins: at the corner, if the last move was blended."""
        tail = self._drive.port.coasting()
        return tail[-1] if tail else self._drive.port.target_q()

    def _pose(self, value: Value) -> Vector6:
        return pose6(value) if isinstance(value, Pose) else self._drive.forward(vector6(value))

    def _joint_path(self, start: Vector6, goal: Vector6) -> Path:
        end = self._drive.waypoint = self._drive.forward(goal)
        metres = _distance(self._drive.forward(start), end)
        return Path(lambda fraction: along(start, goal, fraction), metres)

    def _tool_path(
        self, pose_at: Callable[[float], Vector6], near: Vector6
    ) -> Callable[[float], Vector6]:
        def joints(fraction: float) -> Vector6:
            nonlocal near
            near = self._drive.inverse(pose_at(fraction), near)
            return near

        return joints


def _profile(way: float, v: Value, a: Value, t: Value, most: tuple[float, float]) -> Trapezoid:
    """most: acceleration and speed that a given time may ask for."""
    if number(t) > 0.0:
        return lasting(number(t), way, *most)
    if number(t) < 0.0 or not (number(v) > 0.0 and number(a) > 0.0):
        raise ScriptError(
            f"speed {number(v)} and acceleration {number(a)} must be above 0, time {number(t)} not "
            "below"
        )
    return limited(way, number(v), number(a))


def _distance(start: Vector6, goal: Vector6) -> float:
    return dist(start[:3], goal[:3])


def _way(start: Vector6, goal: Vector6) -> float:
    """The longer of the distance (m) and the turn (rad)."""
    x, y, z, rx, ry, rz = rigid.twist_between(rigid.of(start), rigid.of(goal), 1.0)
    return max(hypot(x, y, z), hypot(rx, ry, rz))
