"""Three bugs of a near side, planted so that a search has something to find."""

from collections import deque
from enum import StrEnum
from typing import Final

from drivers.interfaces import Freshness, Vector6, WrenchReading

MILLISECOND: Final = 1_000_000
SOUND: Final = 10 * MILLISECOND
"""Age at which a sample is stale, ns."""
PATIENCE: Final = 72 * MILLISECOND
"""The same of a near side with a bug: each of the three shows only because nobody stops before."""

GAP: Final = 3
"""Periods without a sample after which a driver with RETARE takes a new zero."""


class Bug(StrEnum):
    """FILLED: a gap is filled with the last sample, which is called new. QUEUE: samples held up are
    handed out a period's worth at a time. RETARE: a gap ends with a new zero, in contact too.
    """

    NONE = "none"
    FILLED = "filled"
    QUEUE = "queue"
    RETARE = "retare"


class Driver:
    """What the sensor's driver makes of a reading before the controller sees it."""

    def __init__(self, bug: Bug, per_period: int) -> None:
        self._bug, self._per_period = bug, per_period
        self._waiting: deque[Vector6] = deque()
        self._gap, self._zero = 0, 0.0

    def read(self, reading: WrenchReading) -> WrenchReading:
        if self._bug is Bug.FILLED and not reading.samples:
            filled = (reading.wrench,) * self._per_period
            return reading._replace(samples=filled, freshness=Freshness.OK, age=0)
        if self._bug is Bug.QUEUE:
            return self._in_turn(reading)
        return self._on_a_new_zero(reading) if self._bug is Bug.RETARE else reading

    def _in_turn(self, reading: WrenchReading) -> WrenchReading:
        self._waiting.extend(reading.samples)
        count = min(self._per_period, len(self._waiting))
        samples = tuple([self._waiting.popleft() for _ in range(count)])
        wrench = samples[-1] if samples else reading.wrench
        return reading._replace(samples=samples, wrench=wrench, age=0)

    def _on_a_new_zero(self, reading: WrenchReading) -> WrenchReading:
        if not reading.samples:
            self._gap += 1
            return reading
        if self._gap >= GAP:
            self._zero = reading.samples[0][2]
        self._gap = 0
        return reading._replace(
            samples=tuple(map(self._less_zero, reading.samples)),
            wrench=self._less_zero(reading.wrench),
        )

    def _less_zero(self, wrench: Vector6) -> Vector6:
        fx, fy, fz, tx, ty, tz = wrench
        return fx, fy, fz - self._zero, tx, ty, tz
