"""From the program's set-points to the joint target: follow, brake, hold.

The arm's physical lag is not here: the plant follows this target as the measured arm does.
"""

from collections.abc import Sequence
from typing import Final

from hil.cell.arm.pose import ZERO6, Vector6

STOP_DECELERATION: Final = 20.0
"""rad/s^2, of a category 2 stop and of a program that stops commanding in motion; assumed."""


class Servo:
    """q, qd, qdd: the joint target of the last cycle, rad, rad/s, rad/s^2.

    path_qd: the part of qd that set-points asked for; force mode adds to it.
    """

    __slots__ = ("_dt", "_next", "_path", "_tail", "path_qd", "q", "qd", "qdd")

    def __init__(self, q: Vector6, dt: float) -> None:
        self.q = q
        self.qd = ZERO6
        self.qdd = ZERO6
        self._dt = dt
        self.path_qd = ZERO6
        self._next: Vector6 | None = None
        self._path: Vector6 | None = None
        self._tail: list[Vector6] = []

    def command(self, q: Vector6) -> None:
        """Set-point of this cycle, rad; the last one before `advance` wins."""
        self._next = q
        self._tail = []

    def coast(self, points: Sequence[Vector6]) -> None:
        """Follow `points` in this and the next cycles, unless a set-point comes: a blend's end."""
        self._tail = list(reversed(points))

    @property
    def coasting(self) -> tuple[Vector6, ...]:
        """What is left of `coast`, rad."""
        return tuple(reversed(self._tail))

    def brake(self, deceleration: float) -> bool:
        """Command one cycle of slowing down, rad/s^2; true once the joints stand."""
        loss = abs(deceleration) * self._dt
        qd = [0.0 if abs(v) <= loss else v - loss if v > 0.0 else v + loss for v in self.path_qd]
        a, b, c, d, e, f = (q + v * self._dt for q, v in zip(self.q, qd, strict=True))
        self.command((a, b, c, d, e, f))
        return not any(qd)

    def give_way(self, q: Vector6, path: Vector6) -> None:
        """Set-point q of a compliant arm; `path` is where the set-points alone would lead."""
        self._next, self._path = q, path

    @property
    def pending(self) -> Vector6 | None:
        """The set-point that `advance` would follow, for the safety system to judge."""
        return self._tail[-1] if self._next is None and self._tail else self._next

    def refuse(self) -> None:
        """Drop this cycle's set-point."""
        self._next = self._path = None
        self._tail = []

    def advance(self) -> None:
        """Follow this cycle's set-point, or slow down and hold where there is none."""
        if self._next is None and self._tail:
            self._next = self._tail.pop()
        if self._next is None:
            if self.qd == ZERO6:
                self.qdd = ZERO6
                return
            self.brake(STOP_DECELERATION)
        assert self._next is not None
        self._follow(self._next)
        self._next = self._path = None

    def _follow(self, q: Vector6) -> None:
        rate = 1.0 / self._dt
        qd = _rate(self.q, q, rate)
        self.qdd = _rate(self.qd, qd, rate)
        self.path_qd = qd if self._path is None else _rate(self.q, self._path, rate)
        self.q, self.qd = q, qd


def _rate(before: Vector6, after: Vector6, rate: float) -> Vector6:
    a0, a1, a2, a3, a4, a5 = before
    b0, b1, b2, b3, b4, b5 = after
    return (
        (b0 - a0) * rate, (b1 - a1) * rate, (b2 - a2) * rate,
        (b3 - a3) * rate, (b4 - a4) * rate, (b5 - a5) * rate,
    )  # fmt: skip
