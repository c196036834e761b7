"""The experience pool as a checkpoint keeps it."""

import numpy as np
from numpy.typing import NDArray

from learner.errors import CheckpointError
from learner.interface import State
from learner.tabular.dice import words
from learner.tabular.rules import ACTIONS, Pool


def empty(states: int, agents: int, rng: np.random.Generator) -> Pool:
    """Q of zero everywhere; the first random word is the real robot's, then one an agent."""
    shape = (states, ACTIONS)
    return Pool(np.zeros(shape), np.zeros(shape), words(rng, 1 + agents))


def saved(pool: Pool) -> State:
    """A copy that later learning leaves alone."""
    return {name: array.copy() for name, array in pool._asdict().items()}


def take_up(pool: Pool, state: State) -> None:
    """Saved tables into the pool's arrays; CheckpointError when they are of another box."""
    for name, mine in pool._asdict().items():
        restore(name, mine, state.get(name))


def restore(name: str, mine: NDArray[np.generic], found: object) -> None:
    """Fill an array from a checkpoint's; CheckpointError when shape or type differ, or it holds NaN
    or infinity: a policy made of them would choose blindly.
    """
    if not isinstance(found, np.ndarray):
        raise CheckpointError(f"'{name}' is missing")
    if (found.shape, found.dtype) != (mine.shape, mine.dtype):
        raise CheckpointError(
            f"'{name}' is {found.dtype} {found.shape}, this learner's {mine.dtype} {mine.shape}"
        )
    if np.issubdtype(found.dtype, np.floating) and not np.isfinite(found).all():
        raise CheckpointError(f"'{name}' holds values that are not finite: its writer had failed")
    mine[...] = found
