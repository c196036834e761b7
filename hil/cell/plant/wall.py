"""A spring-damper wall at z = 0 met by the TCP: the plant with a closed form.

In statics the force is wall_stiffness times penetration. Motion is exact within 0.1 ms pieces, in
each of which the wall is either touched or not. The wall stops the TCP whether or not the jaws
hold a part; friction, slot and play against the wall do not exist here.
"""

from math import isfinite
from typing import NamedTuple

import numpy as np
from scipy.linalg import expm

from hil.cell.errors import PlantError
from hil.cell.plant import servo, truth
from hil.cell.plant.duration import milliseconds
from hil.cell.plant.grip import Jaws, tip_of
from hil.cell.plant.interface import Array, Contact, PartTruth, PlantStep, StageTarget
from hil.cell.plant.tool_wrench import Vector6, sensor_wrench, tool_load
from hil.cell.rig import Rig

PIECES = 10
"""Pieces of a millisecond in which contact is looked at once."""


class Motion(NamedTuple):
    """Position and velocity of an axis, against the point it would come to rest at."""

    q: float
    v: float


class Transition(NamedTuple):
    """Exact motion of a linear oscillator over a fixed time: a 2 x 2 matrix, row by row."""

    qq: float
    qv: float
    vq: float
    vv: float

    def after(self, state: Motion, rest: float) -> Motion:
        q = state.q - rest
        return Motion(
            rest + self.qq * q + self.qv * state.v,
            self.vq * q + self.vv * state.v,
        )


def transition(stiffness: float, damping: float, duration: float) -> Transition:
    """Of q'' = -stiffness q - damping q', both per mass, over `duration` s."""
    rates = np.array([[0.0, 1.0], [-stiffness, -damping]])
    matrix = expm(rates * duration)  # type: ignore[no-untyped-call]
    return Transition(*matrix.ravel().tolist())


class WallPlant:
    """Stage and wall in plain Python; `rng` draws the fixtures' play and nothing else."""

    def __init__(self, rig: Rig, rng: np.random.Generator) -> None:
        w = servo.frequency(rig.robot.servo)
        self._servo = (w**2, 2 * w)
        self._wall = (rig.physics.wall_stiffness, rig.physics.wall_damping)
        piece = 1e-3 / PIECES
        stiffness, damping = (load / servo.MASS for load in self._wall)
        self._free = transition(w**2, 2 * w, piece)
        self._aside = transition(w**2, 2 * w, 1e-3)
        self._touching = transition(w**2 + stiffness, 2 * w + damping, piece)
        self._give = w**2 / (w**2 + stiffness)
        self._tool = tool_load(rig.tool)
        self.jaws = Jaws(rig, rng)
        self._axes = [Motion(0.0, 0.0)] * 4

    def reset(self, stage: StageTarget) -> PlantStep:
        """Start at rest with open jaws; the step's one wrench is the one at rest."""
        _check(stage)
        self.jaws.reset()
        self._axes = [Motion(q, 0.0) for q in stage[:4]]
        return self._observe(np.array([self._wrench(stage)]))

    def step(self, target: StageTarget, duration: int) -> PlantStep:
        """Advance by `duration` ns; raises PlantError for a set-point that is not finite."""
        _check(target)
        samples = milliseconds(duration)
        self.jaws.move(target.jaws_closed, self._stage(), 0.0)
        return self._observe(np.array([self._millisecond(target) for _ in range(samples)]))

    def _millisecond(self, target: StageTarget) -> Vector6:
        x, y, z, theta = self._axes
        for _ in range(PIECES):
            if self._force(z) > 0:
                z = self._touching.after(z, self._give * target.z)
            else:
                z = self._free.after(z, target.z)
        aside = self._aside.after
        self._axes = [aside(x, target.x), aside(y, target.y), z, aside(theta, target.theta)]
        return self._wrench(target)

    def _force(self, z: Motion) -> float:
        """Of the wall on the TCP, N; it pushes and never pulls."""
        stiffness, damping = self._wall
        return max(0.0, -stiffness * z.q - damping * z.v) if z.q < 0 else 0.0

    def _wrench(self, target: StageTarget) -> Vector6:
        stiffness, damping = self._servo
        x, y, z, theta = self._axes
        push = self._force(z)
        ax = stiffness * (target.x - x.q) - damping * x.v
        ay = stiffness * (target.y - y.q) - damping * y.v
        az = stiffness * (target.z - z.q) - damping * z.v + push / servo.MASS
        contact = (0.0, 0.0, push, 0.0, 0.0, 0.0)
        return sensor_wrench(self._tool, theta.q, contact, (0.0, 0.0, 0.0), (ax, ay, az))

    def _stage(self) -> tuple[float, float, float, float]:
        x, y, z, theta = self._axes
        return x.q, y.q, z.q, theta.q

    def _observe(self, wrenches: Array) -> PlantStep:
        x, y, z, theta = self._axes
        return PlantStep(wrenches, self._stage(), (x.v, y.v, z.v, theta.v), self._part())

    def _part(self) -> PartTruth:
        stage, grip = self._stage(), self.jaws.grip
        if grip is None:
            return truth.empty(stage)
        x, y, z, theta = tip_of(stage, grip)
        contact = Contact.FACE if stage[2] < 0 else Contact.FREE
        held = (grip.x, grip.y, grip.theta)
        return PartTruth(grip.name, (x, y, z), theta, 0.0, held, contact)


def _check(target: StageTarget) -> None:
    if not isfinite(target.x + target.y + target.z + target.theta):
        raise PlantError(f"the set-point {tuple(target)} is not finite")
