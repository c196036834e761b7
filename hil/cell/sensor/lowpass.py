"""The sensor's own first-order low-pass, exact for a held input: a = 1 - exp(-2 pi fc / fs)."""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class LowPass:
    """Filters rows sampled at `rate` Hz; starts settled on the first row it sees."""

    def __init__(self, cutoff: float, rate: float) -> None:
        self.cutoff = cutoff
        self._a = -math.expm1(-2 * math.pi * cutoff / rate)
        self._state: Array | None = None

    def filter(self, rows: Array) -> Array:
        """Filtered rows, (n, 6); a cut-off of 0 Hz passes them unchanged."""
        if self.cutoff == 0.0:
            return rows
        state = rows[0] if self._state is None else self._state
        filtered = np.empty_like(rows)
        for index, row in enumerate(rows):
            state = state + self._a * (row - state)
            filtered[index] = state
        self._state = state
        return filtered
