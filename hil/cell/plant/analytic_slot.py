"""The connector as a function: how deep a point is in it, and which way out.

Compiled by numba; scalars only.
"""

from math import sqrt
from typing import NamedTuple

from numba import njit

from hil.cell.rig.parts import Connector

ROOT_HALF = sqrt(0.5)


class Slot(NamedTuple):
    """Half widths, depth and chamfer of the slot, m."""

    half_x: float
    half_y: float
    depth: float
    chamfer: float


class Overlap(NamedTuple):
    """Penetration, m (above 0: inside the connector), and the unit normal that leads out."""

    depth: float
    nx: float
    ny: float
    nz: float


def slot_of(connector: Connector) -> Slot:
    return Slot(connector.width / 2, connector.height / 2, connector.depth, connector.chamfer)


@njit(cache=True)
def overlap(slot: Slot, x: float, y: float, z: float) -> Overlap:
    """Of a point with the connector; beside the slot the nearer way out counts."""
    beyond_x, beyond_y = abs(x) - slot.half_x, abs(y) - slot.half_y
    if beyond_x <= 0 and beyond_y <= 0:
        return Overlap(-slot.depth - z, 0.0, 0.0, 1.0)
    in_x, side_x, up_x = wall(beyond_x, z, slot.chamfer)
    in_y, side_y, up_y = wall(beyond_y, z, slot.chamfer)
    if beyond_x > 0 and (beyond_y <= 0 or in_x >= in_y):
        return Overlap(in_x, side_x if x < 0 else -side_x, 0.0, up_x)
    return Overlap(in_y, 0.0, side_y if y < 0 else -side_y, up_y)


@njit(cache=True)
def wall(beyond: float, z: float, chamfer: float) -> tuple[float, float, float]:
    """Penetration into a wall whose inner side is at beyond = 0: (depth, inward and up normal)."""
    depth, side, up = -z, 0.0, 1.0
    if beyond < depth:
        depth, side, up = beyond, 1.0, 0.0
    slope = (beyond - z - chamfer) * ROOT_HALF
    if slope < depth:
        depth, side, up = slope, ROOT_HALF, ROOT_HALF
    return depth, side, up
