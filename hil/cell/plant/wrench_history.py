"""True wrenches at 1 kHz out of MuJoCo's sensor history.

MuJoCo keeps, for each sensor, a ring: [user, cursor, times (n), values (n x dim)], the cursor at
the newest step. Reading it once a period saves a Python call each millisecond.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from hil.cell.plant.interface import Array

HEADER = 2


class WrenchHistory:
    """Wrenches out of the force and torque rings of one MjData; both turn together."""

    def __init__(self, model: mujoco.MjModel, state: mujoco.MjData, stride: int) -> None:
        """stride: physics steps between two samples."""
        force, torque = (int(a) for a in model.sensor_historyadr)
        self._length = int(model.sensor_history[0, 0])
        self._ring = state.history
        self._cursor = force + 1
        self._rings = force + HEADER + self._length, torque + HEADER + self._length
        self._stride = stride
        self._places: dict[tuple[int, int], NDArray[np.intp]] = {}

    def newest(self, samples: int) -> Array:
        """The last `samples` wrenches on the tool in the sensor's frame, oldest first: (n, 6).

        MuJoCo reports the force that the arm exerts on the tool; what acts on the tool from
        outside, weight and inertia included, is its opposite.
        """
        wrenches = self._ring.take(self._where(int(self._ring[self._cursor]), samples))
        np.negative(wrenches, wrenches)
        gathered: Array = wrenches
        return gathered

    def _where(self, cursor: int, samples: int) -> NDArray[np.intp]:
        """Indices of those samples in the ring, one gather for all of them.  # (n, 6)."""
        key = (cursor, samples)
        if key not in self._places:
            back = np.arange(samples - 1, -1, -1) * self._stride
            rows = 3 * ((cursor - back) % self._length)[:, np.newaxis] + np.arange(3)
            self._places[key] = np.hstack([rows + start for start in self._rings])
        return self._places[key]
