"""Forward and inverse kinematics of the arm's flange, by the nominal DH table of its model."""

from collections.abc import Sequence
from importlib import import_module
from math import cos, dist, pi, sin
from types import ModuleType
from typing import Final, get_args

import numpy as np

from hil.cell.arm.pose import IDENTITY, Pose, Vector3, Vector6, compose, twist_between, vector6
from hil.cell.rig.robot import Model

MODELS: Final[tuple[str, ...]] = get_args(Model)

_NUDGE: Final = 1e-5
"""rad; error of a central difference: 1e-10 of curvature, 1e-11 of rounding."""

_ITERATIONS: Final = 8
_DAMPING: Final = 0.05
"""m and rad per rad: steps stay small where a stretched arm's Jacobian has no inverse."""


class Kinematics:
    """Nominal kinematics of one model; a real arm's calibration moves its flange by 1 to 2 mm."""

    __slots__ = ("_matrix", "_shoulder", "_solver", "_upper_arm")

    def __init__(self, model: str) -> None:
        if model not in MODELS:
            raise ValueError(f"no kinematics for {model!r}, known are {', '.join(MODELS)}")
        self._solver: ModuleType = getattr(import_module("ur_analytic_ik"), model)
        self._matrix = np.identity(4)
        self._upper_arm, self._shoulder = self._elbow_link()

    def forward(self, q: Sequence[float]) -> Pose:
        """Flange in the base frame, m, at joint angles, rad."""
        rows = self._solver.forward_kinematics(*q).tolist()
        (a, b, c, x), (d, e, f, y), (g, h, i, z), _ = rows
        return Pose((x, y, z), ((a, b, c), (d, e, f), (g, h, i)))

    def inverse(self, flange: Pose, near: Sequence[float]) -> Vector6:
        """Joint angles, rad, that put the flange there, nearest to `near`; ValueError for none.

        At the wrist singularity (sin(q5) = 0) only q4 - q6 is determined: the pose is met, but the
        angles need not be near.
        """
        q6 = near[5]
        self._load(flange, sin(q6), cos(q6))
        solutions = self._solver.inverse_kinematics_closest(self._matrix, *near[:5], pi / 2)
        if not solutions:
            raise ValueError(f"no joint angles reach the flange at {flange.position} m")
        q1, q2, q3, q4, q5, turned = solutions[0].tolist()
        return (q1, q2, q3, q4, q5, turned - pi / 2 + q6)

    def nearest(self, flange: Pose, near: Sequence[float]) -> tuple[Vector6, float]:
        """Joint angles, rad, that come closest to a flange out of reach, and by how many m.

        Damped least squares from `near` on: Wampler, IEEE Trans. SMC 16 (1986).
        """
        q = vector6(near)
        for _ in range(_ITERATIONS):
            miss = twist_between(self.forward(q), flange, 1.0)
            rows = np.array([list(row) for row in self.jacobian(q, IDENTITY)])  # (6, 6)
            damped = rows @ rows.T + _DAMPING**2 * np.identity(6)
            q = vector6((np.array(q) + rows.T @ np.linalg.solve(damped, miss)).tolist())
        return q, dist(self.forward(q).position, flange.position)

    def _load(self, flange: Pose, c: float, s: float) -> None:
        """Put the flange, turned about its own axis to q6 = pi/2, into the solver's matrix.

        The solver's equation for q2 + q3 + q4 is 0/0 where cos(q5) and sin(q6) vanish together: a
        tool that hangs down, the commonest pose of all. A turn of the flange moves q6 alone.
        """
        (x, y, z), ((a, b, e), (f, g, h), (i, j, k)) = flange
        self._matrix[:3] = (
            (a * c + b * s, b * c - a * s, e, x),
            (f * c + g * s, g * c - f * s, h, y),
            (i * c + j * s, j * c - i * s, k, z),
        )

    def jacobian(self, q: Sequence[float], tool: Pose) -> tuple[Vector6, ...]:
        """Rows of dx/dq of a tool in the flange's frame, base axes, m/rad and rad/rad.

        By central differences: exact to 1e-9, and for programs that ask, not for the control loop.
        """
        columns = []
        for joint in range(6):
            lower, upper = list(q), list(q)
            lower[joint] -= _NUDGE
            upper[joint] += _NUDGE
            before, after = (compose(self.forward(end), tool) for end in (lower, upper))
            columns.append(twist_between(before, after, 2 * _NUDGE))
        return tuple(vector6(row) for row in zip(*columns, strict=True))

    def elbow(self, q: Vector6) -> Vector3:
        """Elbow joint in the base frame, m."""
        reach = self._upper_arm * cos(q[1])
        height = self._shoulder + self._upper_arm * sin(q[1])
        return (reach * cos(q[0]), reach * sin(q[0]), height)

    def elbow_velocity(self, q: Vector6, qd: Vector6) -> Vector3:
        """Velocity of the elbow joint in the base frame, m/s."""
        a, (c1, s1), (c2, s2) = self._upper_arm, (cos(q[0]), sin(q[0])), (cos(q[1]), sin(q[1]))
        turning, lifting = a * c2 * qd[0], a * s2 * qd[1]
        return (-turning * s1 - lifting * c1, turning * c1 - lifting * s1, a * c2 * qd[1])

    def _elbow_link(self) -> tuple[float, float]:
        """DH parameters a2 and d1, m, from two arms of which one is folded back on the other.

        At q = 0 the flange is at (a2 + a3, -(d4 + d6), d1 - d5); q3 = pi turns a3, and q4 then
        turns d5, the other way round.
        """
        x0, _, z0 = self.forward((0.0, 0.0, 0.0, 0.0, 0.0, 0.0)).position
        x1, _, z1 = self.forward((0.0, 0.0, pi, 0.0, 0.0, 0.0)).position
        return (x0 + x1) / 2, (z0 + z1) / 2
