"""The arm's repeatability: where the flange truly goes, away from where the box believes it is."""

import numpy as np

from hil.cell.arm.pose import ZERO3, Pose, Vector3, shifted


class Repeatability:
    """A constant hidden offset in x, y and z, m; uniform within its half width at every draw."""

    __slots__ = ("_half_width", "_rng", "offset")

    def __init__(self, half_width: float, rng: np.random.Generator) -> None:
        self._half_width = half_width
        self._rng = rng
        self.offset: Vector3 = ZERO3
        self.redraw()

    def redraw(self) -> None:
        """Draw the offset anew: the arm has come back to a pose by another way."""
        x, y, z = self._rng.uniform(-self._half_width, self._half_width, 3).tolist()
        self.offset = (x, y, z)

    def true(self, reported: Pose) -> Pose:
        return shifted(reported, self.offset)

    def reported(self, true: Pose) -> Pose:
        x, y, z = self.offset
        return shifted(true, (-x, -y, -z))
