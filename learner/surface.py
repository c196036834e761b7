"""What a learner holds each pose worth: the surface of the paper's Fig. 12."""

from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from learner.grid import Grid
from learner.interface import Learner
from learner.tabular.rules import Pool

Array = NDArray[np.float64]


@runtime_checkable
class Valued(Protocol):
    """A learner that can say what poses are worth to it."""

    def values(self) -> Array:
        """Worth of each pose of the box, (x, y, theta)."""
        ...


def surface(learner: Learner) -> Array | None:
    """Worth over x and y, each at its best theta, (x, y); None for a learner that knows none."""
    return learner.values().max(axis=2) if isinstance(learner, Valued) else None


def best_q(pool: Pool, grid: Grid) -> Array:
    """Largest Q of each pose, mean of both tables; one table alone where the other is not used."""
    tables = [q for q in (pool.q1, pool.q2) if q.any()] or [pool.q1]
    best: Array = np.mean(tables, axis=0).max(axis=1).reshape(grid.shape)
    return best
