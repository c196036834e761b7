"""Along a path, a step a cycle: the speed slider, blends, and slowing down for the limits."""

from collections.abc import Callable, Iterator
from itertools import count
from math import inf
from typing import Final, NamedTuple

from hil.cell.arm.pose import Vector6
from hil.cell.arm.urscript.builtins.drive import Drive
from hil.cell.arm.urscript.builtins.trapezoid import Trapezoid
from hil.cell.arm.urscript.values import Blocking

MARGIN: Final = 0.95
"""Part of the safety system's speeds that a path uses at most: a box slows a move down rather than
stop for it, whatever time was asked for."""

_INSTANT: Final = 1e-6
"""s that do not make another cycle."""

_TRIES: Final = 4
_SLACK: Final = 0.02
"""How often a cycle's step is cut, and the excess over the margin that then no longer matters."""


class Path(NamedTuple):
    """q_at: joint angles, rad, by part of the way. metres: how far the TCP goes."""

    q_at: Callable[[float], Vector6]
    metres: float


def follow(drive: Drive, path: Path, profile: Trapezoid, radius: float) -> Blocking:
    """Go along the path; with a radius, m, leave the rest of it to the servo."""
    port = drive.port
    tail = port.coasting()
    leave = profile.duration - profile.left(radius / path.metres) if path.metres else inf
    t, q = 0.0, port.target_q()
    for cycle in count():

        def joints(then: float, cycle: int = cycle) -> Vector6:
            return _rounded(path.q_at(_part(profile, then)), tail, cycle)

        step, q = _step(drive, joints, q, t)
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
    drive: Drive, q_at: Callable[[float], Vector6], last: Vector6, t: float
) -> tuple[float, Vector6]:
    """A cycle's step along the profile, s, as the slider and the limits allow, and its joints.

    Near a singularity a straight line asks much of the joints; in movej the TCP may be far out.
    """
    step = drive.period * drive.port.speed_fraction()
    q = q_at(t + step)
    for _ in range(_TRIES):
        used = drive.use_of_limits(last, q) / MARGIN
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
