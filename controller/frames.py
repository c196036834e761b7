"""The task frame: poses between base and connector, wrenches from sensor to connector."""

from math import atan2, cos, hypot, pi, remainder, sin, tau

from controller.place import Place
from drivers.interfaces import Vector6


class TaskFrame:
    """The connector's nominal pose in the base frame: a position (m) and a turn about base z (rad).

    At theta = 0 the TCP's axes are the task frame's turned by pi about x, so the tool's rotation is
    Rz(psi) Rx(pi) with psi = rotation + theta. That is half a turn about the horizontal axis
    (cos psi/2, sin psi/2, 0), which gives both directions in closed form.
    """

    __slots__ = ("_cos", "_position", "_rotation", "_sin")

    def __init__(self, position: tuple[float, float, float], rotation: float = 0.0) -> None:
        self._position = position
        self._rotation = rotation
        self._cos = cos(rotation)
        self._sin = sin(rotation)

    def to_base(self, place: Place) -> Vector6:
        """TCP pose in base (m, rotation vector in rad) of a place in the task frame."""
        x, y, z, theta = place
        px, py, pz = self._position
        half = 0.5 * (self._rotation + theta)
        return (
            px + self._cos * x - self._sin * y,
            py + self._sin * x + self._cos * y,
            pz + z,
            pi * cos(half),
            pi * sin(half),
            0.0,
        )

    def from_base(self, pose: Vector6) -> Place:
        """The place of a TCP pose; theta in [-pi, pi] turns about z, tilt is ignored."""
        px, py, pz = self._position
        dx, dy = pose[0] - px, pose[1] - py
        psi = 2.0 * atan2(pose[4], pose[3])
        return Place(
            self._cos * dx + self._sin * dy,
            self._cos * dy - self._sin * dx,
            pose[2] - pz,
            remainder(psi - self._rotation, tau),
        )


def wrench_to_task(wrench: Vector6, theta: float) -> Vector6:
    """Push of the environment on the tool in the task frame's axes, N and N·m; +z when pressing.

    Only the axes turn: the moments stay about the sensor's origin, which lies on the tool's axis,
    so that tau_z is the moment about the cable's own axis.
    """
    fx, fy, fz, tx, ty, tz = wrench
    c, s = cos(theta), sin(theta)
    return (c * fx + s * fy, s * fx - c * fy, -fz, c * tx + s * ty, s * tx - c * ty, -tz)


def turned(vector: tuple[float, float, float], pose: Vector6) -> tuple[float, float, float]:
    """A vector of the tool's frame in base, by the pose's rotation vector (Rodrigues)."""
    rotation = pose[3:]
    angle = hypot(*rotation)
    if angle == 0.0:
        return vector
    kx, ky, kz = (part / angle for part in rotation)
    x, y, z = vector
    c, s = cos(angle), sin(angle)
    along = (kx * x + ky * y + kz * z) * (1.0 - c)
    return (
        c * x + s * (ky * z - kz * y) + along * kx,
        c * y + s * (kz * x - kx * z) + along * ky,
        c * z + s * (kx * y - ky * x) + along * kz,
    )


def tilt(pose: Vector6) -> float:
    """Angle between the tool's axis and straight down, rad: what `from_base` cannot express."""
    rx, ry, rz = pose[3:]
    angle = hypot(rx, ry, rz)
    if angle == 0.0:
        return pi
    # Rotated z axis, z component: cos a + (rz/a)^2 (1 - cos a); the tool is down when it is -1.
    down = -(cos(angle) + (rz / angle) ** 2 * (1.0 - cos(angle)))
    return atan2((max(0.0, 1.0 - down * down)) ** 0.5, down)
