"""Age of a sample in the arm's time, judged by its number and not by when it arrived."""

from typing import Final

DRIFT: Final = 200e-6
"""Largest rate difference of sensor and arm clock, plus margin: two quartz clocks of 100 ppm."""


class Freshness:
    """The least delayed sample seen anchors the others: a burst that was held somewhere is old
    although it has just arrived. The least delay itself (sensor, wire) cannot be seen from here.

    period: time between two samples, ns.
    """

    def __init__(self, period: int, drift: float = DRIFT) -> None:
        self._period = period
        self._drift = drift
        self._anchor: float | None = None
        self._t = 0

    def restart(self) -> None:
        """Forget the anchor, as after a start, a reset or a change of period."""
        self._anchor = None

    def observe(self, number: int, t: int) -> None:
        """Sample `number` was on this side at arm time t, ns."""
        offset = t - number * self._period
        if self._anchor is None:
            self._anchor = offset
        else:
            # The anchor gives way at the drift, or a slow sensor clock would look like delay.
            leaked = self._anchor + self._drift * (t - self._t)
            self._anchor = min(offset, leaked)
        self._t = t

    def age(self, number: int, t: int) -> int:
        """Age of sample `number` at t beyond the least delay, ns; ValueError before any sample."""
        if self._anchor is None:
            raise ValueError("no sample has been observed yet")
        return max(0, round(t - number * self._period - self._anchor))
