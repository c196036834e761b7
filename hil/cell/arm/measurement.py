"""Where the arm is and where it should be, as its own sensors and its own target tell."""

from typing import Final

from hil.cell.arm.kinematics import Kinematics
from hil.cell.arm.pose import (
    IDENTITY,
    ZERO3,
    ZERO6,
    Pose,
    Vector3,
    Vector6,
    compose,
    inverse,
    of,
    turn,
    twist_at,
    twist_between,
    vector_of,
)  # fmt: skip
from hil.cell.errors import PlantError

NS = 1_000_000_000
OVERREACH: Final = 0.05
"""How far out of reach the plant may put the flange, m. It lags behind a set-point axis by axis, a
tilted arm does not: near a stretched arm, at 1 m/s, the two differ by centimetres.
"""


class Tool:
    """What the program said is mounted: TCP in the flange's frame, payload; m, rad, kg, kg·m²."""

    __slots__ = ("centre_of_gravity", "inertia", "mass", "offset", "pose", "to_flange")

    def __init__(self) -> None:
        self.mass = 0.0
        self.inertia: Vector6 = ZERO6
        self.centre_of_gravity: Vector3 = ZERO3
        self.offset: Vector6 = ZERO6
        self.pose = IDENTITY
        self.to_flange = IDENTITY

    def mount(self, offset: Vector6) -> None:
        """Set the TCP, m and rad in the flange's frame (set_tcp)."""
        self.offset = offset
        self.pose = of(offset)
        self.to_flange = inverse(self.pose)

    def tip(self, flange: Pose) -> Vector3:
        """TCP position with the flange there, m, base frame."""
        (x, y, z), (dx, dy, dz) = flange.position, turn(flange.rotation, self.pose.position)
        return (x + dx, y + dy, z + dz)

    def twist(self, flange: Pose, flange_twist: Vector6) -> Vector6:
        """TCP velocity in the base frame, m/s and rad/s."""
        return twist_at(flange_twist, turn(flange.rotation, self.pose.position))


class Target:
    """The flange that the servo's joint target stands for; TCP values on demand."""

    __slots__ = ("_dt", "_previous", "_tool", "flange")

    def __init__(self, flange: Pose, tool: Tool, dt: float) -> None:
        self.flange = flange
        self._previous = flange
        self._tool = tool
        self._dt = dt

    def advance(self, flange: Pose) -> None:
        self._previous, self.flange = self.flange, flange

    @property
    def pose(self) -> Vector6:
        return vector_of(compose(self.flange, self._tool.pose))

    @property
    def twist(self) -> Vector6:
        if self.flange is self._previous:
            return ZERO6
        return self._tool.twist(self.flange, twist_between(self._previous, self.flange, self._dt))


class Measurement:
    """q, qd: joints, rad and rad/s. force: true wrench at the TCP in the base frame, N and N·m.

    t: bench time of these, ns.
    """

    __slots__ = ("_flange_twist", "_kinematics", "_tool", "flange", "force", "q", "qd", "t")

    def __init__(self, q: Vector6, kinematics: Kinematics, tool: Tool) -> None:
        self.q = q
        self.qd = ZERO6
        self.flange = kinematics.forward(q)
        self.force = ZERO6
        self._flange_twist = ZERO6
        self._kinematics = kinematics
        self._tool = tool
        self.t = 0

    def take(self, t: int, flange: Pose, twist: Vector6, force: Vector6, target: Vector6) -> None:
        """Note the state at bench time t, ns; PlantError when no joint angles explain it.

        Of the joint angles that explain it, those nearest `target`, the servo's: where an arm
        stretches and folds the other way, those nearest the last ones would stay behind. Joint
        speed is the mean since the last call: encoders are differentiated in a real box too.
        """
        before, seconds = self.q, (t - self.t) / NS
        if flange != self.flange:
            self.q = self._angles(flange, target)
            self.flange = flange
        moved = seconds > 0.0 and self.q is not before
        self.qd = _rate(before, self.q, seconds) if moved else ZERO6
        self._flange_twist, self.force, self.t = twist, force, t

    @property
    def pose(self) -> Vector6:
        """TCP in the base frame, m and rad."""
        return vector_of(compose(self.flange, self._tool.pose))

    @property
    def twist(self) -> Vector6:
        """TCP velocity in the base frame, m/s and rad/s."""
        return self._tool.twist(self.flange, self._flange_twist)

    def _angles(self, flange: Pose, target: Vector6) -> Vector6:
        try:
            return self._kinematics.inverse(flange, target)
        except ValueError as error:
            q, miss = self._kinematics.nearest(flange, self.q)
            if miss > OVERREACH:
                raise PlantError(f"the plant moved the arm out of its reach: {error}") from None
            return q


def _rate(before: Vector6, after: Vector6, seconds: float) -> Vector6:
    a0, a1, a2, a3, a4, a5 = before
    b0, b1, b2, b3, b4, b5 = after
    k = 1.0 / seconds
    return (
        (b0 - a0) * k, (b1 - a1) * k, (b2 - a2) * k,
        (b3 - a3) * k, (b4 - a4) * k, (b5 - a5) * k,
    )  # fmt: skip
