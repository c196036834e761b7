"""A one-way link in bench time: what is pushed comes out later, in order, after a drawn delay."""

from collections import deque
from collections.abc import Iterable, Iterator
from typing import Generic, TypeVar

import numpy as np

from hil.cell.rig.latency import LatencyLaw

T = TypeVar("T")
BLOCK = 256
"""Delays drawn at a time: a scalar draw costs a microsecond, a block of them little more."""


class Link(Generic[T]):
    """FIFO: a message never overtakes the one before it, as on a bus or a TCP stream."""

    def __init__(self, law: LatencyLaw, rng: np.random.Generator) -> None:
        self._queue: deque[tuple[int, T]] = deque()
        self._delays = _delays(law, rng)
        self._last = 0

    def push(self, sent: int, message: T) -> None:
        """Put in one message at bench time `sent`, ns."""
        self._last = max(self._last, sent + next(self._delays))
        self._queue.append((self._last, message))

    def extend(self, messages: Iterable[tuple[int, T]]) -> None:
        """Put in (sent, message) pairs: `push` written out, since a bus carries 16 a period."""
        last, delays, append = self._last, self._delays, self._queue.append
        for sent, message in messages:
            last = max(last, sent + next(delays))
            append((last, message))
        self._last = last

    def due(self, t: int) -> list[tuple[int, T]]:
        """Everything that has arrived by t, in order, with the time of its arrival."""
        out = []
        while self._queue and self._queue[0][0] <= t:
            out.append(self._queue.popleft())
        return out


def _delays(law: LatencyLaw, rng: np.random.Generator) -> Iterator[int]:
    while True:
        yield from law.draws(rng, BLOCK)
