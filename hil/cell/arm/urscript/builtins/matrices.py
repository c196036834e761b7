"""Builtins of matrices and arrays (Script Manual, module urmath): software 3.14 and 5.9 on."""

from math import hypot

import numpy as np

from hil.cell.arm import pose as rigid
from hil.cell.arm.urscript.builtins.poses import Poses
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import List, Pose, Value, number, pose6, sequence, vector6

Rows = tuple[tuple[float, ...], ...]


class Matrices:
    """A matrix is a list of lists, its rows."""

    @staticmethod
    def transpose(m: Value) -> List:
        return _matrix(tuple(zip(*rows(m), strict=True)))

    @staticmethod
    def inv(m: Value) -> List | Pose:
        """Inverse of a square matrix, or of a pose."""
        if isinstance(m, Pose):
            return Poses.pose_inv(m)
        table = rows(m)
        if len(table) != len(table[0]):
            raise ScriptError(f"a matrix of {len(table)} by {len(table[0])} has no inverse")
        try:
            return _matrix(tuple(map(tuple, np.linalg.inv(np.array(table)).tolist())))
        except np.linalg.LinAlgError:
            raise ScriptError("the matrix is singular") from None

    @staticmethod
    def size(v: Value) -> int | List:
        """How many elements an array has; [rows, columns] of a matrix."""
        elements = sequence(v)
        if elements and isinstance(elements[0], List):
            return List((len(elements), len(elements[0])))
        return len(elements)

    @staticmethod
    def normalize(v: Value) -> List:
        """The array, of length 1."""
        elements = [number(x) for x in sequence(v)]
        length = hypot(*elements)
        if length == 0.0:
            raise ScriptError("an array of length 0 has no direction")
        return List(x / length for x in elements)

    @staticmethod
    def wrench_trans(T_from_to: Value, w_from: Value) -> List:
        """The same wrench seen at T_from_to and in its axes (as UR's own scripts use it)."""
        frame, wrench = rigid.of(pose6(T_from_to)), vector6(w_from)
        back = rigid.transpose(frame.rotation)
        (x, y, z), (fx, fy, fz), (mx, my, mz) = frame.position, wrench[:3], wrench[3:]
        moved = (mx - y * fz + z * fy, my - z * fx + x * fz, mz - x * fy + y * fx)
        return List((*rigid.turn(back, (fx, fy, fz)), *rigid.turn(back, moved)))


def rows(value: Value) -> Rows:
    """The numbers of a matrix; an error for rows of different lengths."""
    table = tuple(tuple(number(x) for x in sequence(row)) for row in sequence(value))
    if not table or len({len(row) for row in table}) != 1 or not table[0]:
        raise ScriptError("a matrix needs rows of one length")
    return table


def _matrix(table: Rows) -> List:
    return List(List(row) for row in table)
