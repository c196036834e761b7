"""White noise and bias random walk of a transducer, drawn in blocks and handed out row by row."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BLOCK = 512
"""Rows drawn at once: a draw for each period costs four times as much."""


class Disturbance:
    """noise: sigma of each sample. step: sigma of the walk's step between samples.  # (6,) each."""

    def __init__(self, noise: Array, step: Array, rng: np.random.Generator) -> None:
        self._sigma = np.concatenate([noise, step])
        self._rng = rng
        self._walked = np.zeros(6)
        self._rows = np.empty((0, 6))

    def take(self, count: int) -> Array:
        """The next `count` samples' disturbance, (count, 6)."""
        if count > len(self._rows):
            self._rows = np.concatenate([self._rows, self._draw(max(count, BLOCK))])
        taken, self._rows = self._rows[:count], self._rows[count:]
        return taken

    def _draw(self, count: int) -> Array:
        draws = self._rng.standard_normal((count, 12)) * self._sigma
        walk = self._walked + np.add.accumulate(draws[:, 6:])
        self._walked = walk[-1]
        rows: Array = walk + draws[:, :6]
        return rows
