"""The host's part of a zero: what is left after the sensor's own tare, which takes no count."""

import numpy as np

from drivers.interfaces import Vector6


class Zero:
    """offset: subtracted from samples, N and N·m. set: whether it belongs to a finished tare."""

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """No zero but the sensor's."""
        self.offset: Vector6 = (0.0,) * 6
        self.set = False
        self._wanted = 0
        self._rows: list[Vector6] = []

    @property
    def missing(self) -> int:
        """Samples still wanted; 0 when none is being taken."""
        return self._wanted - len(self._rows)

    def begin(self, samples: int) -> None:
        """Zero on the mean of the next `samples` samples."""
        self.clear()
        self._wanted = samples

    def take(self, wrench: Vector6) -> bool:
        """Count a sample in, if any is wanted; whether it completed the zero."""
        if not self.missing:
            return False
        self._rows.append(wrench)
        if self.missing:
            return False
        fx, fy, fz, tx, ty, tz = np.mean(self._rows, axis=0).tolist()
        self.clear()
        self.offset, self.set = (fx, fy, fz, tx, ty, tz), True
        return True

    def apply(self, wrench: Vector6) -> Vector6:
        fx, fy, fz, tx, ty, tz = wrench
        ax, ay, az, bx, by, bz = self.offset
        return fx - ax, fy - ay, fz - az, tx - bx, ty - by, tz - bz
