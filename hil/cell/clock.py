"""The only place in the cell that reads a clock: the wall-paced schedule and its lateness."""

from collections.abc import Callable
from time import monotonic_ns, sleep
from typing import NamedTuple

BIN = 10_000
BINS = 10_000
"""Lateness histogram: 10 us bins to 100 ms, so that a soak of days costs no memory."""

ARREARS = 1_000_000_000
"""Most that is made up for, ns. Nobody wants the hour that a machine slept as fast as it can be
computed, and a host too slow for the rate shall fall behind, not ever deeper into debt.
"""


class Lateness(NamedTuple):
    """How late periods began, ns; missed: those that began after the next one was due.

    forgone: time that was not made up for, ns; bench time is behind the wall's by so much.
    """

    periods: int
    missed: int
    p50: int
    p99: int
    max: int
    forgone: int


class Schedule:
    """Period k is due at start + k * period; nothing less than ARREARS moves that."""

    def __init__(self, period: int, now: Callable[[], int] = monotonic_ns) -> None:
        self._period, self._now = period, now
        self._start = now()
        self._count = 0
        self._missed = 0
        self._max = 0
        self._forgone = 0
        self._bins = [0] * (BINS + 1)

    def remaining(self) -> int:
        """Nanoseconds until the next period is due; 0 or less when it is."""
        return self._due() - self._now()

    def nap(self, duration: int) -> None:
        """Sleep for so many ns."""
        sleep(duration * 1e-9)

    def begin(self) -> None:
        """Note that the next period begins now."""
        late = max(0, self._now() - self._due())
        self._count += 1
        self._missed += late > self._period
        self._max = max(self._max, late)
        self._bins[min(late // BIN, BINS)] += 1
        if late > ARREARS:
            self._start += late
            self._forgone += late

    def lateness(self) -> Lateness:
        """Statistics so far; percentiles are the upper edge of their bin, the maximum beyond."""
        p50, p99 = self._rank(0.5), self._rank(0.99)
        return Lateness(self._count, self._missed, p50, p99, self._max, self._forgone)

    def _due(self) -> int:
        return self._start + (self._count + 1) * self._period

    def _rank(self, share: float) -> int:
        wanted, seen = share * self._count, 0
        for index, count in enumerate(self._bins):
            seen += count
            if count and seen >= wanted:
                return self._max if index == BINS else min((index + 1) * BIN, self._max)
        return 0
