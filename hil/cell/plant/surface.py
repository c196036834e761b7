"""The curved surface as a closed-form plant: a stage, a stylus and a spring, compiled by numba.

Semi-implicit Euler at 50 us. The stage is the one all plants share: pressed, it gives way by
force / (M w^2), so what a set-point meets is surface and servo in series. There are no parts here
and the jaws move nothing.
"""

from math import isfinite
from typing import NamedTuple

import numpy as np
from numba import njit

from hil.cell.errors import PlantError
from hil.cell.plant import servo, truth
from hil.cell.plant.duration import milliseconds
from hil.cell.plant.interface import Array, Contact, PlantStep, StageTarget
from hil.cell.plant.surface_contact import (
    Relief,
    Skin,
    contact_force,
    height_and_slope,
    relief_of,
    skin_of,
)
from hil.cell.plant.tool_wrench import ToolLoad, sensor_wrench, tool_load
from hil.cell.rig import Rig

SUBSTEPS = 20
"""Per millisecond: 100 N/mm on the 5 kg stage turns once in 30 ms, friction settles in 1 ms."""


class Law(NamedTuple):
    """Everything of a rig that the motion needs; frequency is the servo's, rad/s."""

    relief: Relief
    skin: Skin
    tool: ToolLoad
    frequency: float


class SurfacePlant:
    """Nothing in it is random: the same set-points give the same bits for every seed."""

    def __init__(self, rig: Rig) -> None:
        self._law = Law(
            relief_of(rig.surface),
            skin_of(rig.surface),
            tool_load(rig.tool),
            servo.frequency(rig.robot.servo),
        )
        self._q, self._v = np.zeros(4), np.zeros(4)
        # Compiled now: in the first period it would take seconds, and the drivers' patience.
        advance(self._law, np.zeros(4), np.zeros(4), np.zeros(4), np.empty((1, 6)))

    def reset(self, stage: StageTarget) -> PlantStep:
        """Start at rest; the step's one wrench is the one at rest."""
        _check(stage)
        self._q[:], self._v[:] = stage[:4], 0.0
        still = (0.0, 0.0, 0.0)
        x, z = stage.x, stage.z
        fx, fz = contact_force(self._law.relief, self._law.skin, (x, z), (0.0, 0.0))
        load = (fx, 0.0, fz, 0.0, 0.0, 0.0)
        return self._observe(
            np.array([sensor_wrench(self._law.tool, stage.theta, load, still, still)])
        )

    def step(self, target: StageTarget, duration: int) -> PlantStep:
        """Advance by `duration` ns; raises PlantError when physics breaks."""
        _check(target)
        wrenches = np.empty((milliseconds(duration), 6))
        advance(self._law, self._q, self._v, np.array(target[:4]), wrenches)
        return self._observe(wrenches)

    def _observe(self, wrenches: Array) -> PlantStep:
        x, y, z, theta = self._q.tolist()
        vx, vy, vz, turn = self._v.tolist()
        if not isfinite(x + y + z + theta + vx + vy + vz + turn):
            raise PlantError("the surface plant left its domain: positions are not finite")
        stage = (x, y, z, theta)
        touching = z < height_and_slope(self._law.relief, x)[0]
        part = truth.empty(stage, Contact.FACE if touching else Contact.FREE)
        return PlantStep(wrenches, stage, (vx, vy, vz, turn), part)


@njit(cache=True)
def advance(law: Law, q: Array, v: Array, target: Array, wrenches: Array) -> None:
    """Advance stage q, v (4,) by one ms a row of `wrenches` (n, 6), writing each row at its end."""
    dt = 1e-3 / SUBSTEPS
    acceleration = np.zeros(4)
    fx, fz = 0.0, 0.0
    for row in wrenches:
        for _ in range(SUBSTEPS):
            fx, fz = contact_force(law.relief, law.skin, (q[0], q[2]), (v[0], v[2]))
            for axis in range(4):
                lag = law.frequency * (target[axis] - q[axis]) - 2.0 * v[axis]
                acceleration[axis] = law.frequency * lag
            acceleration[0] += fx / servo.MASS
            acceleration[2] += fz / servo.MASS
            for axis in range(4):
                v[axis] += dt * acceleration[axis]
                q[axis] += dt * v[axis]
        linear = (acceleration[0], acceleration[1], acceleration[2])
        load = (fx, 0.0, fz, 0.0, 0.0, 0.0)
        row[:] = sensor_wrench(law.tool, q[3], load, (0.0, 0.0, 0.0), linear)


def _check(target: StageTarget) -> None:
    if not isfinite(target.x + target.y + target.z + target.theta):
        raise PlantError(f"the set-point {tuple(target)} is not finite")
