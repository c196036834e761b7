"""Builtins that move along a path: movej, movel, movep, movec and the optimo pair."""

from collections.abc import Callable, Iterator
from itertools import count
from math import dist, hypot, inf
from typing import Final, NamedTuple

from hil.cell.arm import pose as rigid
from hil.cell.arm.pose import Vector6
from hil.cell.arm.urscript.builtins.arc import arc
from hil.cell.arm.urscript.builtins.drive import Drive, along
from hil.cell.arm.urscript.builtins.poses import between
from hil.cell.arm.urscript.builtins.trapezoid import Trapezoid, lasting, limited
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Blocking, Pose, Value, integer, number, pose6, vector6

_INSTANT: Final = 1e-6
"""s that do not make another cycle."""

_MARGIN: Final = 0.95
"""Part of the safety system's speeds that a path uses at most: a box slows a move down rather than
stop for it, whatever time was asked for."""

_TRIES: Final = 4
_SLACK: Final = 0.02
"""How often a cycle's step is cut, and the excess over the margin that then no longer matters."""

_JOINT_LIMITS: Final = (40.0, 3.14)
_TOOL_LIMITS: Final = (10.0, 1.0)
"""Acceleration and speed that optimovej and optimovel take fractions of, and an acceleration no
given time exceeds; assumed.
"""


class Path(NamedTuple):
    """q_at: joint angles, rad, by part of the way. metres: how far the TCP goes."""

    q_at: Callable[[float], Vector6]
    metres: float


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
        yield from self._follow(self._joint_path(start, goal), profile, number(r))

    def movel(
        self, pose: Value, a: Value = 1.2, v: Value = 0.25, t: Value = 0.0, r: Value = 0.0
    ) -> Blocking:
        """On a straight line of the TCP; a and v hold for m or rad, whichever is more."""
        near = self._start()
        start, goal = self._drive.forward(near), self._pose(pose)
        self._drive.waypoint = goal
        path = self._tool_path(lambda fraction: between(start, goal, fraction), near)
        profile = _profile(_way(start, goal), self._allowed(v, 1), a, t, self._most(1))
        yield from self._follow(Path(path, _distance(start, goal)), profile, number(r))

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
        yield from self._follow(path, profile, number(r))

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
        return min(number(v), _MARGIN * self._drive.port.speed_limits()[limit])

    def _most(self, limit: int) -> tuple[float, float]:
        """Acceleration and speed that a move takes at most; limit: 0 joints, 1 TCP."""
        speed = _MARGIN * self._drive.port.speed_limits()[limit]
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

    def _follow(self, path: Path, profile: Trapezoid, radius: float) -> Blocking:
        """Go along the path; with a radius, leave the rest of it to the servo."""
        drive, port = self._drive, self._drive.port
        tail = port.coasting()
        leave = profile.duration - profile.left(radius / path.metres) if path.metres else inf
        t, q = 0.0, port.target_q()
        for cycle in count():

            def joints(then: float, cycle: int = cycle) -> Vector6:
                return _rounded(path.q_at(_part(profile, then)), tail, cycle)

            step, q = self._step(joints, q, t, drive.period * port.speed_fraction())
            t += step
            if radius > 0.0 and step > 0.0 and t >= leave:
                rest = list(_times(t, step, profile.duration, len(tail) - cycle))
                port.coast([joints(then, cycle + i) for i, then in enumerate(rest)])
                return
            drive.to(q)
            yield
            if _part(profile, t) == 1.0 and cycle + 1 >= len(tail):
                return

    def _step(
        self, q_at: Callable[[float], Vector6], last: Vector6, t: float, step: float
    ) -> tuple[float, Vector6]:
        """The part of `step`, s, that keeps joints and TCP within the limits, and its joint angles.

        Near a singularity a straight line asks much of the joints; in movej the TCP may be far out.
        """
        q = q_at(t + step)
        for _ in range(_TRIES):
            used = self._drive.use_of_limits(last, q) / _MARGIN
            if used <= 1.0 + _SLACK:
                break
            step /= used
            q = q_at(t + step)
        return step, q


def _times(t: float, step: float, end: float, at_least: int) -> Iterator[float]:
    """The cycles from t to the end of a profile, s, and not fewer than `at_least`."""
    for i in count():
        yield t + i * step
        if t + i * step >= end - _INSTANT and i + 1 >= at_least:
            return


def _part(profile: Trapezoid, t: float) -> float:
    """Of the way, 0..1; the whole of it where what is left makes no other cycle."""
    return 1.0 if t >= profile.duration - _INSTANT else profile.fraction(t)


def _rounded(q: Vector6, tail: tuple[Vector6, ...], cycle: int) -> Vector6:
    """`q` and what the move before has left to go to the corner in this cycle."""
    if cycle >= len(tail):
        return q
    a, b, c, d, e, f = (x + y - z for x, y, z in zip(q, tail[cycle], tail[-1], strict=True))
    return (a, b, c, d, e, f)


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
