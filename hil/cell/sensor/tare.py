"""The node's zero: what it subtracts from every sample, and how a new one is taken."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

IntArray = NDArray[np.int64]
Done: TypeAlias = Callable[[int], None]
"""Called with the number of the first sample on the new zero."""


class Tare:
    """offset: counts subtracted, (6,). set: whether it is a tare at all."""

    def __init__(self) -> None:
        self.offset: IntArray = np.zeros(6, np.int64)
        self.set = False
        self._wanted = 0
        self._rows: list[IntArray] = []
        self._done: Done | None = None

    @property
    def busy(self) -> bool:
        return self._done is not None

    def clear(self) -> None:
        self.offset = np.zeros(6, np.int64)
        self.set = False

    def begin(self, samples: int, done: Done) -> None:
        """Zero on the mean of the next `samples` samples, then call `done`."""
        self._wanted, self._done, self._rows = samples, done, []

    def abandon(self) -> None:
        self._done = None

    def apply(self, values: IntArray, first: int) -> tuple[IntArray, int]:
        """Tared values and how many of them, from the start, are still on the old zero.

        values: untared counts of the samples numbered from `first`, (n, 6).
        """
        if self._done is None:
            return values - self.offset, 0
        old = min(len(values), self._wanted - len(self._rows))
        self._rows.extend(values[:old])
        tared = values - self.offset
        if len(self._rows) < self._wanted:
            return tared, len(values)
        done, self._done = self._done, None
        self.offset = np.rint(np.mean(self._rows, axis=0)).astype(np.int64)
        tared[old:] = values[old:] - self.offset
        self.set = True
        done(first + old)
        return tared, old
