"""The parameter server: an evaluation model of poses, trained from the real robot's outcomes.

As printed it is a Softmax classifier on the pose. A linear one cannot say "this pose and no other
succeeds" (its classes are half spaces), which costs the method 15 points; a quadratic one
can, and remembering each pose's last outcome is what reproduces the paper's figures best.
"""

from enum import Enum

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.special import log_softmax, softmax

from learner.grid import Grid
from learner.parallel.outcomes import CLASSES, FAIL, Classes, Outcomes

Array = NDArray[np.float64]

DECAY = 1e-3
"""L2 weight: keeps separable classes from growing their weights without end."""


class Model(Enum):
    """LINEAR: Softmax as printed. QUADRATIC: on squares and products too. LAST: no model at all."""

    LINEAR = "linear"
    QUADRATIC = "quadratic"
    LAST = "last-label"


class Server:
    """Keeps what the real robot met, and judges poses by it.

    model, and how many outcomes it knows: its version, which a learner compares with its own.
    """

    def __init__(self, model: Model, grid: Grid) -> None:
        self.model, self._grid = model, grid
        self.outcomes = Outcomes(grid.states)

    def answer(self) -> Classes | None:
        """What it holds each pose for, (states,); None before the first success, and of a
        classifier that has met nothing else yet.
        """
        classes_met = np.count_nonzero(self.outcomes.counts.sum(axis=0))
        if not self.outcomes.successes or (self.model is not Model.LAST and classes_met < 2):
            return None
        return evaluate(self.model, self._grid, self.outcomes)

    def restart(self) -> None:
        """Begin anew, knowing nothing."""
        self.outcomes = Outcomes(self._grid.states)


def evaluate(model: Model, grid: Grid, outcomes: Outcomes) -> Classes:
    """Which class the server holds each pose for: FAIL, SUCCESS or DANGER, (states,)."""
    if model is Model.LAST:
        return np.where(outcomes.last < 0, FAIL, outcomes.last).astype(np.int8)
    features = _features(grid, quadratic=model is Model.QUADRATIC)
    weights = train(features, outcomes.counts)
    classes: Classes = np.argmax(features @ weights, axis=1).astype(np.int8)
    return classes


def train(features: Array, counts: NDArray[np.int64]) -> Array:
    """Weights of the Softmax classifier, (features, 3), from outcome counts, (states, 3).

    Raises ValueError for counts without two classes: there is nothing to tell apart.
    """
    if np.count_nonzero(counts.sum(axis=0)) < 2:
        raise ValueError("a classifier needs outcomes of at least two classes")
    seen = counts.sum(axis=1) > 0
    x, y = features[seen], counts[seen].astype(np.float64)
    found = minimize(  # type: ignore[no-untyped-call]
        _loss, np.zeros(features.shape[1] * CLASSES), (x, y), jac=True, method="L-BFGS-B"
    )
    weights: Array = found.x.reshape(-1, CLASSES)
    return weights


def _loss(flat: Array, x: Array, y: Array) -> tuple[float, Array]:
    """Mean negative log likelihood and its gradient."""
    weights = flat.reshape(-1, CLASSES)
    scores, total = x @ weights, y.sum()
    loss = -(y * log_softmax(scores, axis=1)).sum() / total + 0.5 * DECAY * flat @ flat
    slope = x.T @ (softmax(scores, axis=1) * y.sum(axis=1, keepdims=True) - y) / total
    return float(loss), slope.ravel() + DECAY * flat


def _features(grid: Grid, *, quadratic: bool) -> Array:
    """1, x, y, theta, each over the box's half width, and with `quadratic` their products."""
    cells = np.array([grid.at(row) for row in range(grid.states)], float)
    u, v, w = (cells / np.maximum(1, grid.halves)).T
    columns = [np.ones(grid.states), u, v, w]
    if quadratic:
        columns += [u * u, v * v, w * w, u * v, u * w, v * w]
    return np.stack(columns, axis=1)
