"""The curved surface as a MuJoCo plant: the cross-check of the closed-form one.

Contact is MuJoCo's own, compliance a spring under the surface along z. Friction is a law laid over
the physics each millisecond: MuJoCo's own lifts a hard tip off a light sprung surface at every few
steps of a slide (measured: a push of 11.7 N falls to 0.5 N every 7 ms).
"""

from math import isfinite, sqrt

import mujoco
import numpy as np

from hil.cell.errors import PlantError
from hil.cell.plant import mjcf_surface, truth
from hil.cell.plant.duration import milliseconds, steps_per_millisecond
from hil.cell.plant.interface import Array, Contact, PlantStep, StageTarget
from hil.cell.plant.surface_contact import friction, height_and_slope, relief_of, skin_of
from hil.cell.plant.wrench_history import WrenchHistory
from hil.cell.rig import Rig

LONGEST_PERIOD = 16
"""Length of the sensor history and so of a period, ms."""


class MujocoSurfacePlant:
    """Nothing in it is random; there are no parts here and the jaws move nothing."""

    def __init__(self, rig: Rig) -> None:
        self._stride = steps_per_millisecond(rig.physics)
        self.model = mjcf_surface.build(rig, LONGEST_PERIOD * self._stride)
        self.state = mujoco.MjData(self.model)
        self._history = WrenchHistory(self.model, self.state, self._stride)
        self._skin, self._relief = skin_of(rig.surface), relief_of(rig.surface)
        self._lever = rig.tool.length - rig.tool.centre_of_mass
        self._tool = int(self.model.body("tool").id)
        self._spring = int(self.model.joint("surface").qposadr[0])
        joints = (self.model.joint(name) for name in ("x", "y", "z", "theta"))
        self._q = [int(joint.qposadr[0]) for joint in joints]

    def reset(self, stage: StageTarget) -> PlantStep:
        """Start at rest; the step's one wrench is the one at rest."""
        _check(stage)
        mujoco.mj_resetData(self.model, self.state)  # clears the friction too
        self.state.qpos[self._q] = stage[:4]
        self.state.ctrl[:] = stage[:4]
        mujoco.mj_forward(self.model, self.state)
        return self._observe(-self.state.sensordata[np.newaxis])

    def step(self, target: StageTarget, duration: int) -> PlantStep:
        """Advance by `duration` ns, at most 16 ms; raises PlantError when physics breaks."""
        samples = milliseconds(duration)
        if samples > LONGEST_PERIOD:
            raise PlantError(f"a period of {samples} ms exceeds {LONGEST_PERIOD} ms")
        _check(target)
        self.state.ctrl[:] = target[:4]
        for _ in range(samples):
            self._rub()
            mujoco.mj_step(self.model, self.state, nstep=self._stride)
        return self._observe(self._history.newest(samples))

    def _rub(self) -> None:
        """Put friction on the tip for the next millisecond; its lever ends at the tool's centre."""
        x, z = self._q[0], self._q[2]
        slope = height_and_slope(self._relief, self.state.qpos[x])[1]
        c = 1.0 / sqrt(1.0 + slope * slope)
        push = max(0.0, -self._skin.stiffness * self.state.qpos[self._spring]) / c
        sliding = c * self.state.qvel[x] + slope * c * self.state.qvel[z]
        drag = friction(self._skin, push, sliding)
        fx, fz = -c * drag, -slope * c * drag
        self.state.xfrc_applied[self._tool] = fx, 0.0, fz, 0.0, -self._lever * fx, 0.0

    def _observe(self, wrenches: Array) -> PlantStep:
        x, y, z, theta = self.state.qpos[self._q].tolist()
        vx, vy, vz, turn = self.state.qvel[self._q].tolist()
        if self.state.warning.number.any() or not isfinite(sum((x, y, z, theta, vx, vy, vz, turn))):
            raise PlantError(f"MuJoCo left its domain at {self.state.time:.4f} s")
        stage = (x, y, z, theta)
        part = truth.empty(stage, Contact.FACE if self.state.ncon else Contact.FREE)
        return PlantStep(wrenches, stage, (vx, vy, vz, turn), part)


def _check(target: StageTarget) -> None:
    if not isfinite(target.x + target.y + target.z + target.theta):
        raise PlantError(f"the set-point {tuple(target)} is not finite")
