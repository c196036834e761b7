"""The MuJoCo plant of the paper's cell, with faults of its materials and of what it meets."""

from typing import Final

import numpy as np

from hil.cell.faults.injector import Running
from hil.cell.injection.injection import Injection, Switch
from hil.cell.plant.ffc import FfcPlant
from hil.cell.plant.interface import Contact, PlantStep, StageTarget
from hil.cell.plant.mjcf_connector import BELOW
from hil.cell.rig import Rig

NEAR: Final = 50e-6
"""A tip this near a blocked slot's floor meets it, m."""
_PADS: Final = ("pad_x", "pad_y", "pad_z", "pad_tilt")


class InjectedFfcPlant(FfcPlant):
    """P2 stiffness and friction, P3 blocked slot or kinked cable, P4 an obstacle under the tool,
    G1 a slip in the jaws. An obstacle is a spring under the jaws, met from above.
    """

    def __init__(self, rig: Rig, rng: np.random.Generator, injection: Injection) -> None:
        super().__init__(rig, rng)
        self._injection = injection
        model = self.model
        self._segments, self._depth_of_slot = rig.cable.segments, rig.connector.depth
        self._stiffness, self._friction = model.jnt_stiffness.copy(), model.geom_friction.copy()
        self._floor = model.geom("floor").id
        self._floor_z = float(model.geom_pos[self._floor, 2])
        hinges = [model.joint(f"bend{index}").qposadr[0] for index in range(rig.cable.segments)]
        self._hinges = np.array(hinges, dtype=np.intp)
        self._push = self.state.xfrc_applied[model.body("jaws").id]  # (6,)
        self._obstacles: dict[int, float] = {}
        self._t = 0
        injection.add(
            self,
            Switch(injection, "P2", self._alter, self._as_built),
            Switch(injection, "P3", self._damage, self._whole),
        )

    def before(self, t: int) -> None:
        self._t = t
        for one in self._injection.of("G1"):
            if one.fault.word("what") == "slip" and self.jaws.grip is not None:
                self._cable.shift(one.fault.number("slip"))
                one.done(t, "the part slips")

    def after(self, t: int) -> None:
        """A blocked slot has an effect once the tip stands on it."""
        for one in self._injection.of("P3"):
            blocked = one.fault.word("what") == "blocked"
            if blocked and self._depth >= one.fault.number("depth") - NEAR and self._touches:
                one.felt(t, "the tip meets the block")

    def step(self, target: StageTarget, duration: int) -> PlantStep:
        for one in self._injection.of("P4"):
            self._obstacles.setdefault(one.index, self._stage[2] - one.fault.number("below"))
        step = super().step(target, duration)
        self._touches = step.part.contact is not Contact.FREE
        return step

    _touches = False

    def _advance(self, samples: int) -> None:
        obstacles = self._injection.of("P4")
        self._push[2] = 0.0
        if not obstacles:
            super()._advance(samples)
            return
        for _ in range(samples):
            self._push[2] = sum(self._obstacle(one) for one in obstacles)
            super()._advance(1)

    def _obstacle(self, one: Running) -> float:
        """Push along z, N."""
        inside = self._obstacles[one.index] - float(self.state.qpos[2])
        if inside <= 0.0:
            return 0.0
        one.felt(self._t, "the tool meets an obstacle")
        return inside * one.fault.number("stiffness")

    def _alter(self, one: Running, t: int) -> None:
        stiffness, friction = one.fault.number("stiffness"), one.fault.number("friction")
        model = self.model
        for name in (*_PADS, *(f"bend{index}" for index in range(self._segments))):
            joint = model.joint(name).id
            model.jnt_stiffness[joint] = self._stiffness[joint] * stiffness
        model.geom_friction[:, 0] = self._friction[:, 0] * friction
        one.felt(t, f"stiffness x {stiffness:g}, friction x {friction:g}")

    def _as_built(self) -> None:
        self.model.jnt_stiffness[:] = self._stiffness
        self.model.geom_friction[:] = self._friction

    def _damage(self, one: Running, t: int) -> None:
        if one.fault.word("what") == "blocked":
            # No deeper than the slot, and below the tip: what is there cannot come into the part.
            depth = max(min(one.fault.number("depth"), self._depth_of_slot), self._depth)
            self.model.geom_pos[self._floor, 2] = -depth - BELOW / 2
            return
        self.model.qpos_spring[self._hinges] = one.fault.number("angle") / self._segments
        one.felt(t, "the cable is kinked")

    def _whole(self) -> None:
        self.model.geom_pos[self._floor, 2] = self._floor_z
        self.model.qpos_spring[self._hinges] = 0.0
