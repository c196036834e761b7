"""Hysteresis of a strain gauge: one play operator whose width follows the peak excursion."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Hysteresis:
    """Reading minus load is -width * (load - play): up and down branches differ by
    width * peak, and after a peak the zero is off by half of that.

    The play is half the peak wide, so small motions inside the band lose slope, never the signal.
    """

    def __init__(self, width: float) -> None:
        self._width = width
        self._half = np.zeros(6)  # half of the peak excursion
        self._play = np.zeros(6)

    def follow(self, loads: Array) -> Array:
        """Readings of consecutive loads, (n, 6)."""
        if self._width == 0.0:
            return loads
        slack = loads - self._play
        # Mostly the load stays inside the band; the play stands still, and no peak can grow, since
        # the play is never further out than the band is wide.
        if np.count_nonzero(np.abs(slack) > self._half):
            self._half = np.maximum(self._half, 0.5 * np.maximum.reduce(np.abs(loads)))
            slack = loads - self._drag(loads)
        return loads - self._width * slack

    def _drag(self, loads: Array) -> Array:
        """Play after each load, (n, 6): pulled along where a load leaves the band."""
        track = np.empty_like(loads)
        play = self._play
        for low, high, row in zip(loads - self._half, loads + self._half, track, strict=True):
            play = np.minimum(np.maximum(play, low), high, out=row)
        self._play = track[-1].copy()
        return track
