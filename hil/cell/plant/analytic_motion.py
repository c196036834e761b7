"""Equations of motion of stage and cable tip for the analytic plant, compiled by numba.

State: stage (x, y, z, theta), then tip (x, y, z, theta), in the task frame; the tip hangs on four
springs with the jaws' axes. Semi-implicit Euler.
"""

from math import cos, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from hil.cell.plant.analytic_contact import Load, Touch, contact_load
from hil.cell.plant.interface import Array
from hil.cell.plant.tool_wrench import ToolLoad, sensor_wrench


class Suspension(NamedTuple):
    """Springs from jaws to tip: stiffness and damping along x, y, z, about z; the tip's inertia."""

    stiffness: tuple[float, float, float, float]
    damping: tuple[float, float, float, float]
    inertia: tuple[float, float, float, float]


class Terminals(NamedTuple):
    """Friction inside the slot: full force, N; where it starts and its ramp, m; bristle, N/m."""

    force: float
    start: float
    ramp: float
    stiffness: float


class Law(NamedTuple):
    """Everything of a rig that the motion needs; frequency and inertia are the stage's."""

    touch: Touch
    suspension: Suspension
    terminals: Terminals
    tool: ToolLoad
    frequency: float
    inertia: tuple[float, float, float, float]
    substeps: int


class State(NamedTuple):
    """q, v: stage and tip (8,). rest: where the springs rest against the TCP, in the jaws' axes
    (4,). feet: the bristles', the terminals' own in the last row (15, 3).
    """

    q: Array
    v: Array
    rest: Array
    feet: Array


@njit(cache=True)
def advance(law: Law, state: State, target: Array, held: bool, wrenches: Array) -> None:
    """Advance by one ms for each row of `wrenches` (n, 6) and write the wrench at its end."""
    for row in wrenches:
        millisecond(law, state, target, held, row)


@njit(cache=True)
def millisecond(law: Law, state: State, target: Array, held: bool, wrench: Array) -> None:
    """Substeps of one sensor period; without a cable in the jaws only the stage moves."""
    q, v, dt = state.q, state.v, 1e-3 / law.substeps
    acceleration = np.zeros(4)
    pull = (0.0, 0.0, 0.0, 0.0)
    for _ in range(law.substeps):
        if held:
            pull = suspension_load(law.suspension, q, v, state.rest)
            move_tip(law, state, pull, dt)
        for axis in range(4):
            lag = law.frequency * (target[axis] - q[axis]) - 2 * v[axis]
            acceleration[axis] = law.frequency * lag - pull[axis] / law.inertia[axis]
            v[axis] += dt * acceleration[axis]
            q[axis] += dt * v[axis]
    load = (-pull[0], -pull[1], -pull[2], 0.0, 0.0, -pull[3])
    tip = (q[4] - q[0], q[5] - q[1], q[6] - q[2]) if held else (0.0, 0.0, 0.0)
    linear = (acceleration[0], acceleration[1], acceleration[2])
    wrench[:] = sensor_wrench(law.tool, q[3], load, tip, linear)


@njit(cache=True)
def suspension_load(suspension: Suspension, q: Array, v: Array, rest: Array) -> Load:
    """Force and moment of the springs on the tip, task frame."""
    c, s = cos(q[3]), sin(q[3])
    dx, dy, ux, uy = q[4] - q[0], q[5] - q[1], v[4] - v[0], v[5] - v[1]
    k, d = suspension.stiffness, suspension.damping
    fx = k[0] * (rest[0] - c * dx - s * dy) - d[0] * (c * ux + s * uy)
    fy = k[1] * (rest[1] - c * dy + s * dx) - d[1] * (c * uy - s * ux)
    fz = k[2] * (rest[2] - q[6] + q[2]) - d[2] * (v[6] - v[2])
    mz = k[3] * (rest[3] - q[7] + q[3]) - d[3] * (v[7] - v[3])
    return c * fx - s * fy, s * fx + c * fy, fz, mz


@njit(cache=True)
def move_tip(law: Law, state: State, pull: Load, dt: float) -> None:
    """Advance the tip by dt under springs, contact and terminals."""
    q, v, feet = state.q, state.v, state.feet
    push = contact_load(law.touch, q[4:], v[4:], feet, dt)
    grip = terminal_force(law.terminals, q[6], feet[-1])
    inertia = law.suspension.inertia
    v[4] += dt * (pull[0] + push[0]) / inertia[0]
    v[5] += dt * (pull[1] + push[1]) / inertia[1]
    v[6] += dt * (pull[2] + push[2] + grip) / inertia[2]
    v[7] += dt * (pull[3] + push[3]) / inertia[3]
    for axis in range(4, 8):
        q[axis] += dt * v[axis]


@njit(cache=True)
def terminal_force(terminals: Terminals, z: float, foot: Array) -> float:
    """The bristle law of `mating`, its foot at foot[0]."""
    share = min(1.0, max(0.0, (-z - terminals.start) / terminals.ramp))
    limit = terminals.force * share
    pull: float = min(limit, max(-limit, terminals.stiffness * (foot[0] - z)))
    foot[0] = z + pull / terminals.stiffness
    return pull
