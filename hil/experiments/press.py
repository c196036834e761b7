"""A cable held over the connector and pressed with a constant force, straight on a plant.

For experiments on physics alone: no wire, no arm. Force follows the admittance law
v = (m v / T + f - f_d) / (m / T + b), implicit because b T / m exceeds 1 at 125 Hz.
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from hil.cell.plant.interface import Array, Plant, PlantStep, StageTarget
from hil.cell.rig import Rig

NewPlant: TypeAlias = Callable[[Rig, np.random.Generator], Plant]

PERIOD = 8_000_000
HEIGHT = 0.3e-3
"""Where a trial starts above the face, m."""
MASS, DAMPING = 1.0, 1000.0
"""Of the admittance, kg and N s/m."""


def over_connector(rig: Rig, x: float = 0.0, y: float = 0.0, theta: float = 0.0) -> Rig:
    """The rig with one part, waiting without play just above the connector."""
    origin = rig.connector.position
    position = (origin[0] + x, origin[1] + y, origin[2] + HEIGHT)
    part = rig.fixture.parts[0].model_copy(update={"position": position, "rotation": theta})
    still = {"parts": (part,), "play": 0.0, "play_rotation": 0.0}
    return rig.model_copy(update={"fixture": rig.fixture.model_copy(update=still)})


def with_values(rig: Rig, section: str, **values: object) -> Rig:
    """The rig with other values in one of its sections."""
    changed = getattr(rig, section).model_copy(update=values)
    return rig.model_copy(update={section: changed})


class Press:
    """One trial: grip over the connector at (x, y, theta), tare in the air, then press.

    period: of control, ns.
    """

    def __init__(
        self,
        plant: NewPlant,
        rig: Rig,
        x: float = 0.0,
        y: float = 0.0,
        theta: float = 0.0,
        *,
        period: int = PERIOD,
    ) -> None:
        self._period, self._seconds = period, period * 1e-9
        self.plant = plant(over_connector(rig, x, y, theta), np.random.default_rng(0))
        self._force_wanted = rig.task.contact_force
        self._x, self._y, self._z, self._theta = x, y, HEIGHT, theta
        self._v = 0.0
        self.plant.reset(self._target(closed=False))
        self.last: PlantStep = self.plant.step(self._target(closed=True), self._period)
        self._tare = self.last.wrenches[-1].copy()

    @property
    def wrench(self) -> Array:
        """Mean of the last period, tared, in the sensor's frame.  # (6,)."""
        mean: Array = self.last.wrenches.mean(axis=0) - self._tare
        return mean

    @property
    def force(self) -> float:
        """Of the cable on the connector, N."""
        return -float(self.wrench[2])

    def press(self, dx: float = 0.0, dy: float = 0.0, dtheta: float = 0.0) -> Array:
        """One period at constant force, the stage moved on by a step; returns the wrench."""
        excess = self.force - self._force_wanted
        self._v = (MASS * self._v / self._seconds + excess) / (MASS / self._seconds + DAMPING)
        return self.move(dx, dy, self._v * self._seconds, dtheta)

    def move(self, dx: float = 0.0, dy: float = 0.0, dz: float = 0.0, dtheta: float = 0.0) -> Array:
        """One period with the set-point moved on by a step; returns the wrench."""
        self._x, self._y, self._z = self._x + dx, self._y + dy, self._z + dz
        self._theta += dtheta
        self.last = self.plant.step(self._target(closed=True), self._period)
        return self.wrench

    def open(self) -> None:
        """Let the cable go."""
        self.last = self.plant.step(self._target(closed=False), self._period)

    def _target(self, closed: bool) -> StageTarget:
        return StageTarget(self._x, self._y, self._z, self._theta, closed)
