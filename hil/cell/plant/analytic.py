"""The fast plant: a rigid cable edge on four springs against the slot's closed form, in numba.

For simulated agents and as a cross-check of `ffc`. It knows lateral bending, pad compliance,
twist, friction and the terminals; it has no in-plane tilt, so it accepts about half the capture
volume of the MuJoCo plant, and it cannot buckle. Gripping is the same event.
"""

from math import cos, isfinite, sin, sqrt

import numpy as np

from hil.cell.errors import PlantError
from hil.cell.plant import beam, mating, servo, slip, truth
from hil.cell.plant.analytic_contact import POINTS, Edge, Surface, Touch, touches
from hil.cell.plant.analytic_motion import Law, State, Suspension, Terminals, advance
from hil.cell.plant.analytic_slot import slot_of
from hil.cell.plant.duration import milliseconds
from hil.cell.plant.grip import Jaws, Stage, tip_of
from hil.cell.plant.interface import Array, PlantStep, StageTarget
from hil.cell.plant.slip import STUCK, PadState
from hil.cell.plant.tool_wrench import sensor_wrench, tool_load
from hil.cell.rig import Rig
from hil.cell.rig.parts import Connector

SUBSTEPS = 10
"""Per millisecond: explicit contact needs 0.1 ms, whatever physics.step asks of MuJoCo."""
TIP_MASS = 0.05
"""Effective mass of the tip, kg; the cable's own would need 1 us steps (assumed)."""
SURFACE_STIFFNESS = 150e3
"""Of each sample point, N/m: 2 um of penetration at 5 N over fourteen points."""
BRISTLE_STIFFNESS, BRISTLE_DAMPING = 80e3, 20.0


class AnalyticPlant:
    """`rng` draws the fixtures' play and nothing else; the sensor's signs are those of `ffc`."""

    def __init__(self, rig: Rig, rng: np.random.Generator) -> None:
        self._law = law_of(rig)
        self._pad = rig.pad
        self.jaws = Jaws(rig, rng)
        self._observer = truth.Observer(rig.connector)
        self._q, self._v, self._rest = np.zeros(8), np.zeros(8), np.zeros(4)
        self._feet = np.zeros((2 * POINTS + 1, 3))
        self._state = State(self._q, self._v, self._rest, self._feet)
        self._slip = STUCK
        self._depth = 0.0

    def reset(self, stage: StageTarget) -> PlantStep:
        """Start at rest with open jaws; the step's one wrench is the one at rest."""
        _check(stage)
        self.jaws.reset()
        self._q[:4] = stage[:4]
        self._v[:] = 0.0
        still = (0.0, 0.0, 0.0)
        weight = sensor_wrench(self._law.tool, stage.theta, (0.0,) * 6, still, still)
        return self._observe(np.array([weight]))

    def step(self, target: StageTarget, duration: int) -> PlantStep:
        """Advance by `duration` ns; raises PlantError when physics breaks."""
        _check(target)
        samples = milliseconds(duration)
        if self.jaws.move(target.jaws_closed, self._stage(), self._depth):
            self._hang()
        held = self.jaws.grip is not None
        wrenches = np.empty((samples, 6))
        advance(self._law, self._state, np.array(target[:4]), held, wrenches)
        if held:
            self._slide()
        return self._observe(wrenches)

    def _hang(self) -> None:
        """Put a resting cable into the jaws where the grip says; without a grip, nothing."""
        self._feet[:] = 0.0
        self._slip = STUCK
        grip = self.jaws.grip
        if grip is not None:
            self._rest[:] = grip.x, grip.y, grip.z, grip.theta
            self._q[4:] = tip_of(self._stage(), grip)
            self._v[4:] = 0.0

    def _slide(self) -> None:
        """Slip in the jaws, once a period; the springs' rest carries it."""
        grip, (x, y, z, theta) = self.jaws.grip, self._stage()
        if grip is None:
            return
        dx, dy = self._q[4] - x, self._q[5] - y
        along = float(cos(theta) * dx + sin(theta) * dy) - grip.x
        root = PadState(along, float(self._q[6] - z) - grip.z, 0.0)
        self._slip = slip.slipped(self._pad, root, self._slip)
        self._rest[0], self._rest[2] = grip.x + self._slip.x, grip.z + self._slip.z

    def _stage(self) -> Stage:
        x, y, z, theta = self._q[:4].tolist()
        return x, y, z, theta

    def _observe(self, wrenches: Array) -> PlantStep:
        vx, vy, vz, turn = self._v[:4].tolist()
        x, y, z, theta = self._q[4:].tolist()
        stage, grip = self._stage(), self.jaws.grip
        if not isfinite(sum(stage) + x + y + z + theta + vx + vy + vz + turn):
            raise PlantError("the analytic plant left its domain: positions are not finite")
        if grip is None:
            part = truth.empty(stage)
        else:
            touching = bool(touches(self._law.touch, self._q[4:]))
            part = self._observer.part(grip, self._slip.x, (x, y, z), theta, touching)
        self._depth = part.depth
        return PlantStep(wrenches, stage, (vx, vy, vz, turn), part)


def law_of(rig: Rig) -> Law:
    """The equations' constants for a rig."""
    connector = rig.connector
    return Law(
        touch=Touch(
            slot_of(connector), Edge(rig.cable.width, rig.cable.thickness), _surface(connector)
        ),
        suspension=_suspension(rig),
        terminals=Terminals(
            connector.mating_force,
            connector.mating_start,
            connector.mating_ramp,
            mating.STIFFNESS,
        ),
        tool=tool_load(rig.tool),
        frequency=servo.frequency(rig.robot.servo),
        inertia=(servo.MASS, servo.MASS, servo.MASS, servo.INERTIA),
        substeps=SUBSTEPS,
    )


def _surface(connector: Connector) -> Surface:
    damping = 2 * 0.3 * sqrt(SURFACE_STIFFNESS * TIP_MASS)
    return Surface(
        SURFACE_STIFFNESS, damping, BRISTLE_STIFFNESS, BRISTLE_DAMPING, connector.friction
    )


def _suspension(rig: Rig) -> Suspension:
    pad, twist_inertia = rig.pad, TIP_MASS * rig.cable.width**2 / 12
    lateral = 1 / (1 / pad.stiffness_y + 1 / beam.tip_stiffness(rig.cable))
    k = (pad.stiffness_x, lateral, pad.stiffness_z, beam.twist_stiffness(rig.cable))
    m = (TIP_MASS, TIP_MASS, TIP_MASS, twist_inertia)
    d = [2 * pad.damping_ratio * sqrt(a * b) for a, b in zip(k, m, strict=True)]
    return Suspension(k, (d[0], d[1], d[2], d[3]), m)


def _check(target: StageTarget) -> None:
    if not isfinite(target.x + target.y + target.z + target.theta):
        raise PlantError(f"the set-point {tuple(target)} is not finite")
