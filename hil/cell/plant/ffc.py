"""The plant of the paper's cell: a flat cable pressed into a connector's slot, in MuJoCo.

Events: gripping and letting go (from one period to the next the cable hangs in the jaws, or is
gone). Contact: pressing, friction, finding the slot, sliding in, bottoming, jamming and buckling
all come out of MuJoCo. Laws laid over it: the terminals' friction (`mating`) and slip in the jaws
(`slip`).
"""

from math import isfinite

import mujoco
import numpy as np

from hil.cell.errors import PlantError
from hil.cell.plant import mjcf, truth
from hil.cell.plant.duration import milliseconds, steps_per_millisecond
from hil.cell.plant.ffc_cable import GrippedCable
from hil.cell.plant.grip import Jaws, Stage
from hil.cell.plant.interface import Array, PartTruth, PlantStep, StageTarget
from hil.cell.plant.wrench_history import WrenchHistory
from hil.cell.rig import Rig

LONGEST_PERIOD = 16
"""Length of the sensor history and so of a period, ms."""
INSERTION_SPEED = 0.05
"""Fastest way into the slot that the terminals' friction is ready for, m/s."""
SLIP_WATCH = 0.5
"""Share of the jaws' friction beyond which slip is looked at each millisecond."""


class FfcPlant:
    """MuJoCo with a four-axis stage; `rng` draws the fixtures' play and nothing else.

    The sensor's z points out of the tool: the face pushing the tool up is a negative fz, the
    tool's weight a positive one. A period is one call into MuJoCo unless the tip nears the
    terminals or the jaws near slip; then it is one a millisecond, with the same physics steps.
    """

    def __init__(self, rig: Rig, rng: np.random.Generator) -> None:
        self._stride = steps_per_millisecond(rig.physics)
        self.model = mjcf.build(rig, LONGEST_PERIOD * self._stride)
        self.state = mujoco.MjData(self.model)
        self._history = WrenchHistory(self.model, self.state, self._stride)
        self._cable = GrippedCable(rig, self.model, self.state)
        self._observer = truth.Observer(rig.connector)
        self.jaws = Jaws(rig, rng)
        self._mating_start = rig.connector.mating_start
        self._warnings = self.state.warning.number
        self._calm = bytes(self._warnings.nbytes)
        self._stage: Stage = (0.0, 0.0, 0.0, 0.0)
        self._depth = 0.0

    def reset(self, stage: StageTarget) -> PlantStep:
        """Start at rest with open jaws; the step's one wrench is the one at rest."""
        _check(stage)
        mujoco.mj_resetData(self.model, self.state)
        self.jaws.reset()
        self._cable.remove()
        self.state.qpos[:4] = stage[:4]
        self.state.ctrl[:] = stage[:4]
        mujoco.mj_forward(self.model, self.state)
        return self._observe(-self.state.sensordata[np.newaxis])

    def step(self, target: StageTarget, duration: int) -> PlantStep:
        """Advance by `duration` ns, at most 16 ms; raises PlantError when physics breaks."""
        samples = milliseconds(duration)
        if samples > LONGEST_PERIOD:
            raise PlantError(f"a period of {samples} ms exceeds {LONGEST_PERIOD} ms")
        _check(target)
        if self.jaws.move(target.jaws_closed, self._stage, self._depth):
            self._change_cable()
        self.state.ctrl[:] = target[:4]
        self._advance(samples)
        return self._observe(self._history.newest(samples))

    def _change_cable(self) -> None:
        grip = self.jaws.grip
        if grip is None:
            self._cable.remove()
        else:
            self._cable.hang(grip)

    def _advance(self, samples: int) -> None:
        mating = self._depth > self._mating_start - INSERTION_SPEED * samples * 1e-3
        if self.jaws.grip is None or not (mating or self._cable.slip_load() > SLIP_WATCH):
            self._cable.let_go()
            mujoco.mj_step(self.model, self.state, nstep=samples * self._stride)
            return
        for _ in range(samples):
            self._cable.resist()
            mujoco.mj_step(self.model, self.state, nstep=self._stride)
            self._cable.slip()

    def _observe(self, wrenches: Array) -> PlantStep:
        mujoco.mj_kinematics(self.model, self.state)
        q, v = self.state.qpos.tolist(), self.state.qvel[:4].tolist()
        if self._warnings.tobytes() != self._calm or not isfinite(sum(q) + sum(v)):
            raise PlantError(
                f"MuJoCo left its domain at {self.state.time:.4f} s: {self._complaint()}"
            )
        self._stage = (q[0], q[1], q[2], q[3])
        part = self._part()
        self._depth = part.depth
        return PlantStep(wrenches, self._stage, (v[0], v[1], v[2], v[3]), part, tuple(q))

    def _part(self) -> PartTruth:
        grip = self.jaws.grip
        if grip is None:
            return truth.empty(self._stage)
        tip, theta = self._cable.tip()
        return self._observer.part(grip, self._cable.rest.x, tip, theta, self.state.ncon > 0)

    def _complaint(self) -> str:
        raised = [mujoco.mjtWarning(i).name for i in np.flatnonzero(self._warnings)]
        return ", ".join(raised) or "positions are not finite"


def _check(target: StageTarget) -> None:
    if not isfinite(target.x + target.y + target.z + target.theta):
        raise PlantError(f"the set-point {tuple(target)} is not finite")
