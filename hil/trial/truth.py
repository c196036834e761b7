"""The true push on the tool: what the plant's wrench says once weight and inertia are taken off."""

from collections import deque
from math import cos, sin
from typing import Final

from hil.cell.plant.interface import PlantStep

G: Final = 9.81
WINDOW: Final = 8
"""Samples of the mean, ms: the window that the force bound is defined on."""

Vector4 = tuple[float, float, float, float]


class Push:
    """Contact force (N) and moment about the tool's axis (N·m) in the task frame.

    The sensor is emulated for its own errors; this is what it would say if it had none, were zeroed
    with the tool hanging still, and did not feel the tool being accelerated.
    """

    def __init__(self, mass: float, period: int) -> None:
        """mass: of the tool, kg. period: of control, ns."""
        self._mass = mass
        self._dt = period * 1e-9
        self._samples: deque[Vector4] = deque(maxlen=WINDOW)
        self._velocity: Vector4 | None = None

    def take(self, step: PlantStep) -> Vector4:
        """The mean of the last 8 ms after one more control period."""
        last, self._velocity = self._velocity or step.velocity, step.velocity
        ax, ay, az, _ = ((v - w) / self._dt for v, w in zip(step.velocity, last, strict=True))
        m = self._mass
        c, s = cos(step.stage[3]), sin(step.stage[3])
        for fx, fy, fz, _, _, tz in step.wrenches.tolist():
            self._samples.append(
                (c * fx + s * fy + m * ax, s * fx - c * fy + m * ay, m * (G + az) - fz, -tz)
            )
        n = len(self._samples)
        fx, fy, fz, tz = map(sum, zip(*self._samples, strict=True))
        return fx / n, fy / n, fz / n, tz / n
