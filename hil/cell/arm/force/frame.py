"""The axes of a force mode task: URScript's three ways to turn the given frame."""

from math import hypot
from typing import Final

from hil.cell.arm.pose import Pose, Rotation, Vector3, transpose, turn

POINT: Final = 1
FIXED: Final = 2
MOTION: Final = 3
KINDS: Final = (POINT, FIXED, MOTION)
"""Script Manual, force_mode, type: y points from the TCP to the frame's origin; not turned; x is
the TCP's velocity projected on the frame's x-y plane."""

_SHORT: Final = 1e-6
"""m or m/s under which a direction says nothing, and the frame stays as it is given."""


def task_axes(kind: int, frame: Pose, tcp: Vector3, velocity: Vector3) -> Rotation:
    """Rows are the task's axes in the base frame.

    tcp: m, velocity: m/s, of the TCP in the base frame.
    """
    given = transpose(frame.rotation)
    if kind == POINT:
        (x, y, z), (px, py, pz) = frame.position, tcp
        return _towards((x - px, y - py, z - pz), given)
    if kind == MOTION:
        along, across, _ = turn(given, velocity)
        return _turned_about_z(given, along, across)
    return given


def _towards(direction: Vector3, given: Rotation) -> Rotation:
    """The axis y along `direction`, x as near as it can be to the given one."""
    y = _unit(direction)
    if y is None:
        return given
    z = _unit(_cross(given[0], y)) or _unit(_cross(y, given[2]))
    assert z is not None  # the given x and z cannot both be parallel to y
    return _cross(y, z), y, z


def _turned_about_z(given: Rotation, along: float, across: float) -> Rotation:
    length = hypot(along, across)
    if length < _SHORT:
        return given
    c, s = along / length, across / length
    (x0, x1, x2), (y0, y1, y2), z = given
    return (
        (c * x0 + s * y0, c * x1 + s * y1, c * x2 + s * y2),
        (c * y0 - s * x0, c * y1 - s * x1, c * y2 - s * x2),
        z,
    )


def _unit(v: Vector3) -> Vector3 | None:
    length = hypot(*v)
    return None if length < _SHORT else (v[0] / length, v[1] / length, v[2] / length)


def _cross(a: Vector3, b: Vector3) -> Vector3:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
