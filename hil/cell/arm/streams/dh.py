"""The Denavit-Hartenberg table of an arm, as the primary interface reports it."""

import struct
from math import pi
from typing import Final, NamedTuple
from zlib import crc32

from hil.cell.arm.kinematics import Kinematics
from hil.cell.arm.pose import Vector6

ALPHA: Final[Vector6] = (pi / 2, 0.0, 0.0, pi / 2, -pi / 2, 0.0)
THETA: Final[Vector6] = (0.0,) * 6


class Table(NamedTuple):
    """a, d in m; alpha, theta in rad."""

    a: Vector6
    d: Vector6
    alpha: Vector6
    theta: Vector6

    @property
    def checksums(self) -> tuple[int, ...]:
        """One number a joint that changes with its row."""
        return tuple(crc32(struct.pack(">4d", *row)) for row in zip(*self, strict=True))


def table(kinematics: Kinematics) -> Table:
    """The nominal table, read off three poses of the solver that the cell itself uses.

    At q = 0 the flange is at (a2 + a3, -(d4 + d6), d1 - d5); q3 = pi turns a3 and d5 round, and
    q5 = pi turns d6 round.
    """
    x, y, z = kinematics.forward(THETA).position
    folded_x, _, folded_z = kinematics.forward((0.0, 0.0, pi, 0.0, 0.0, 0.0)).position
    _, turned_y, _ = kinematics.forward((0.0, 0.0, 0.0, 0.0, pi, 0.0)).position
    a2, a3 = (x + folded_x) / 2, (x - folded_x) / 2
    d1, d5 = (z + folded_z) / 2, (folded_z - z) / 2
    d4, d6 = -(y + turned_y) / 2, (turned_y - y) / 2
    return Table((0.0, a2, a3, 0.0, 0.0, 0.0), (d1, 0.0, 0.0, d4, d5, d6), ALPHA, THETA)
