"""One random number at a time inside compiled loops: splitmix64, one word of state each.

A numpy Generator cannot be kept in an array; a word can, so every agent has its own and neither the
number of agents nor the pacing of a loop changes another's numbers. Steele, Lea and Flood 2014.
"""

import numpy as np
from numba import njit, uint64
from numpy.typing import NDArray

Words = NDArray[np.uint64]


def words(rng: np.random.Generator, count: int) -> Words:
    """So many independent starting states, drawn from `rng`; (count,)."""
    drawn: Words = rng.integers(0, 1 << 64, count, dtype=np.uint64)
    return drawn


@njit(cache=True)
def uniform(state: Words, i: int) -> float:
    """The next number of word i in [0, 1)."""
    state[i] += uint64(0x9E3779B97F4A7C15)
    z = state[i]
    z = (z ^ (z >> uint64(30))) * uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> uint64(27))) * uint64(0x94D049BB133111EB)
    z ^= z >> uint64(31)
    number: float = (z >> uint64(11)) * (1.0 / 9007199254740992.0)
    return number


@njit(cache=True)
def below(state: Words, i: int, n: int) -> int:
    """The next number of word i in 0 .. n - 1."""
    return int(uniform(state, i) * n)
