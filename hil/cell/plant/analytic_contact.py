"""Contact of the cable's edge with the slot: penalty normal force, bristle friction.

Compiled by numba. The edge is sampled at the corners and five points between; each point drags
its own bristle, an elastic foot that slides once the friction cone is full.
"""

from math import cos, sin, sqrt
from typing import NamedTuple, TypeAlias

from numba import njit

from hil.cell.plant.analytic_slot import Slot, overlap
from hil.cell.plant.interface import Array

Load: TypeAlias = tuple[float, float, float, float]

POINTS = 7
"""Sample points along each of the edge's two long sides."""


class Surface(NamedTuple):
    """Stiffness, N/m, and damping, N s/m, along the normal and of the bristles; friction."""

    stiffness: float
    damping: float
    bristle_stiffness: float
    bristle_damping: float
    friction: float


class Edge(NamedTuple):
    """Width and thickness of the cable's edge, m."""

    width: float
    thickness: float


class Touch(NamedTuple):
    """All that contact depends on: the slot, the edge that meets it, and what both are made of."""

    slot: Slot
    edge: Edge
    surface: Surface


@njit(cache=True)
def touches(touch: Touch, tip: Array) -> bool:
    """Whether any sample point is inside the connector."""
    for k in range(2 * POINTS):
        rx, ry = point(touch.edge, tip[3], k)
        if overlap(touch.slot, tip[0] + rx, tip[1] + ry, tip[2]).depth > 0:
            return True
    return False


@njit(cache=True)
def point(edge: Edge, theta: float, k: int) -> tuple[float, float]:
    """The k-th sample point against the tip's middle, task axes, m."""
    along = edge.width * ((k // 2) / (POINTS - 1) - 0.5)
    across = edge.thickness * (k % 2 - 0.5)
    c, s = cos(theta), sin(theta)
    return c * along - s * across, s * along + c * across


@njit(cache=True)
def contact_load(touch: Touch, tip: Array, speed: Array, feet: Array, dt: float) -> Load:
    """Force, N, and moment about z, N·m, on the tip; moves the bristles' feet.  # feet (14, 3)."""
    surface = touch.surface
    fx, fy, fz, mz = 0.0, 0.0, 0.0, 0.0
    for k in range(2 * POINTS):
        rx, ry = point(touch.edge, tip[3], k)
        into = overlap(touch.slot, tip[0] + rx, tip[1] + ry, tip[2])
        if into.depth <= 0:
            feet[k, :] = 0.0
            continue
        vx, vy, vz = speed[0] - speed[3] * ry, speed[1] + speed[3] * rx, speed[2]
        vn = vx * into.nx + vy * into.ny + vz * into.nz
        push = max(0.0, surface.stiffness * into.depth - surface.damping * vn)
        slide = (vx - vn * into.nx, vy - vn * into.ny, vz - vn * into.nz)
        tx, ty, tz = drag(surface, push, slide, feet[k], dt)
        fx += tx + push * into.nx
        fy += ty + push * into.ny
        fz += tz + push * into.nz
        mz += rx * (ty + push * into.ny) - ry * (tx + push * into.nx)
    return fx, fy, fz, mz


@njit(cache=True)
def drag(
    surface: Surface, push: float, slide: tuple[float, float, float], foot: Array, dt: float
) -> tuple[float, float, float]:
    """Friction force of one point sliding at `slide` m/s; lets the foot slip on the cone."""
    k, damping = surface.bristle_stiffness, surface.bristle_damping
    tx = -k * (foot[0] + slide[0] * dt) - damping * slide[0]
    ty = -k * (foot[1] + slide[1] * dt) - damping * slide[1]
    tz = -k * (foot[2] + slide[2] * dt) - damping * slide[2]
    size, limit = sqrt(tx * tx + ty * ty + tz * tz), surface.friction * push
    if size <= limit:
        for axis in range(3):
            foot[axis] += slide[axis] * dt
        return tx, ty, tz
    share = limit / size
    foot[0], foot[1], foot[2] = -share * tx / k, -share * ty / k, -share * tz / k
    return share * tx, share * ty, share * tz
