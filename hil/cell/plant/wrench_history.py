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
    """A view of the force and torque rings of one MjData; both turn together."""

    def __init__(self, model: mujoco.MjModel, state: mujoco.MjData, stride: int) -> None:
        """stride: physics steps between two samples."""
        force, torque = (int(a) for a in model.sensor_historyadr)
        self._length = int(model.sensor_history[0, 0])
        self._ring = state.history
        self._cursor = force + 1
        self._force = self._values(force)  # (length, 3)
        self._torque = self._values(torque)  # (length, 3)
        self._stride = stride
        self._rows: dict[tuple[int, int], NDArray[np.intp]] = {}

    def newest(self, samples: int) -> Array:
        """The last `samples` wrenches on the tool in the sensor's frame, oldest first: (n, 6).

        MuJoCo reports the force that the arm exerts on the tool; what acts on the tool from
        outside, weight and inertia included, is its opposite.
        """
        rows = self._take(int(self._ring[self._cursor]), samples)
        wrenches = np.empty((samples, 6))
        np.negative(self._force[rows], out=wrenches[:, :3])
        np.negative(self._torque[rows], out=wrenches[:, 3:])
        return wrenches

    def _take(self, cursor: int, samples: int) -> NDArray[np.intp]:
        key = (cursor, samples)
        if key not in self._rows:
            back = np.arange(samples - 1, -1, -1) * self._stride
            self._rows[key] = (cursor - back) % self._length
        return self._rows[key]

    def _values(self, address: int) -> Array:
        first = address + HEADER + self._length
        values: Array = self._ring[first : first + 3 * self._length].reshape(self._length, 3)
        return values
