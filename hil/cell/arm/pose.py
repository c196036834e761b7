"""Rigid poses in plain floats: rotation vectors, composition, inverse, difference.

Written out by hand because one call of scipy's Rotation costs more than this whole control cycle
may (10 us against 1 us, measured).
"""

from collections.abc import Sequence
from math import atan2, cos, isfinite, pi, sin, sqrt
from typing import Final, NamedTuple, TypeAlias

Vector3: TypeAlias = tuple[float, float, float]
Vector6: TypeAlias = tuple[float, float, float, float, float, float]
Rotation: TypeAlias = tuple[Vector3, Vector3, Vector3]

HALF_TURN_BAND: Final = 1e-9
"""rad; rotations this near to pi count as exact half turns."""

ZERO3: Final[Vector3] = (0.0, 0.0, 0.0)
ZERO6: Final[Vector6] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Pose(NamedTuple):
    """position: m. rotation: rows of the matrix whose columns are the frame's axes."""

    position: Vector3
    rotation: Rotation


IDENTITY: Final = Pose(ZERO3, ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))


def vector6(values: Sequence[float]) -> Vector6:
    """Six finite floats; ValueError otherwise."""
    a, b, c, d, e, f = (float(value) for value in values)
    if not isfinite(a + b + c + d + e + f):
        raise ValueError(f"six finite numbers are needed, found {tuple(values)}")
    return (a, b, c, d, e, f)


def rotation_of(rx: float, ry: float, rz: float) -> Rotation:
    """The matrix of a rotation vector, rad (Rodrigues)."""
    angle = sqrt(rx * rx + ry * ry + rz * rz)
    if angle < 1e-12:
        return ((1.0, -rz, ry), (rz, 1.0, -rx), (-ry, rx, 1.0))
    s, c = sin(angle), cos(angle)
    x, y, z = rx / angle, ry / angle, rz / angle
    v = 1.0 - c
    return (
        (c + x * x * v, x * y * v - z * s, x * z * v + y * s),
        (x * y * v + z * s, c + y * y * v, y * z * v - x * s),
        (x * z * v - y * s, y * z * v + x * s, c + z * z * v),
    )


def rotation_vector(rotation: Rotation) -> Vector3:
    """The rotation vector of a matrix, rad, of length 0..pi."""
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = rotation
    x, y, z = r21 - r12, r02 - r20, r10 - r01
    twice_sine = sqrt(x * x + y * y + z * z)
    cosine = (r00 + r11 + r22 - 1.0) * 0.5
    if twice_sine > 1e-6:
        angle = atan2(0.5 * twice_sine, cosine)  # acos loses half its digits near 0
        k = angle / twice_sine
        return (x * k, y * k, z * k)
    if cosine > 0.0:
        return (0.5 * x, 0.5 * y, 0.5 * z)
    return _half_turn(rotation, (x, y, z))


def _half_turn(rotation: Rotation, sine_axis: Vector3) -> Vector3:
    """Near pi the antisymmetric part vanishes: the axis comes from R + R^T = 2 (2 a a^T - I).

    Of an exact half turn's two vectors this is the one whose largest component is positive, so
    that rounding does not flip the reported pose of a tool that hangs down.
    """
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = rotation
    if r00 >= r11 and r00 >= r22:
        x, y, z = r00 + 1.0, 0.5 * (r01 + r10), 0.5 * (r02 + r20)
    elif r11 >= r22:
        x, y, z = 0.5 * (r01 + r10), r11 + 1.0, 0.5 * (r12 + r21)
    else:
        x, y, z = 0.5 * (r02 + r20), 0.5 * (r12 + r21), r22 + 1.0
    k = 1.0 / sqrt(x * x + y * y + z * z)
    twice_sine = (x * sine_axis[0] + y * sine_axis[1] + z * sine_axis[2]) * k
    angle = pi - 0.5 * abs(twice_sine)
    k *= -angle if twice_sine < -HALF_TURN_BAND else angle
    return (x * k, y * k, z * k)


def of(vector: Vector6) -> Pose:
    """The pose of (x, y, z, rx, ry, rz), m and rad."""
    x, y, z, rx, ry, rz = vector
    return Pose((x, y, z), rotation_of(rx, ry, rz))


def vector_of(pose: Pose) -> Vector6:
    """(x, y, z, rx, ry, rz) of a pose, m and rad."""
    return pose.position + rotation_vector(pose.rotation)


def turn(rotation: Rotation, v: Vector3) -> Vector3:
    """Turn a vector: rotation * v."""
    (a, b, c), (d, e, f), (g, h, i) = rotation
    x, y, z = v
    return (a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z)


def transpose(rotation: Rotation) -> Rotation:
    (a, b, c), (d, e, f), (g, h, i) = rotation
    return ((a, d, g), (b, e, h), (c, f, i))


def product(left: Rotation, right: Rotation) -> Rotation:
    """Turn after turn: left * right."""
    (a, b, c), (d, e, f), (g, h, i) = left
    (j, k, m), (n, o, p), (q, r, s) = right
    return (
        (a * j + b * n + c * q, a * k + b * o + c * r, a * m + b * p + c * s),
        (d * j + e * n + f * q, d * k + e * o + f * r, d * m + e * p + f * s),
        (g * j + h * n + i * q, g * k + h * o + i * r, g * m + h * p + i * s),
    )


def compose(outer: Pose, inner: Pose) -> Pose:
    """Express `inner`, given in `outer`'s frame, in the frame that `outer` is given in."""
    x, y, z = turn(outer.rotation, inner.position)
    px, py, pz = outer.position
    return Pose((px + x, py + y, pz + z), product(outer.rotation, inner.rotation))


def inverse(pose: Pose) -> Pose:
    back = transpose(pose.rotation)
    x, y, z = turn(back, pose.position)
    return Pose((-x, -y, -z), back)


def shifted(pose: Pose, offset: Vector3) -> Pose:
    """`pose` moved by `offset`, m, along the axes it is given in."""
    (x, y, z), (dx, dy, dz) = pose.position, offset
    return Pose((x + dx, y + dy, z + dz), pose.rotation)


def twist_between(before: Pose, after: Pose, seconds: float) -> Vector6:
    """Mean velocity from one pose to the next, m/s and rad/s, in the axes both are given in."""
    (x0, y0, z0), (x1, y1, z1) = before.position, after.position
    wx, wy, wz = rotation_vector(product(after.rotation, transpose(before.rotation)))
    k = 1.0 / seconds
    return ((x1 - x0) * k, (y1 - y0) * k, (z1 - z0) * k, wx * k, wy * k, wz * k)


def twist_at(twist: Vector6, lever: Vector3) -> Vector6:
    """The twist of a point rigidly joined to where `twist` is known, `lever` away, m."""
    vx, vy, vz, wx, wy, wz = twist
    x, y, z = lever
    return (vx + wy * z - wz * y, vy + wz * x - wx * z, vz + wx * y - wy * x, wx, wy, wz)
