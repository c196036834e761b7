"""Allan deviation of a sampled signal, overlapping estimate."""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def allan_deviation(samples: Array, rate: float, tau: float) -> float:
    """Deviation of means over `tau` s from one to the next, in the signal's unit.

    ValueError unless the record holds two such means.
    """
    m = max(1, round(tau * rate))
    if len(samples) < 2 * m + 1:
        raise ValueError(f"{len(samples)} samples at {rate:g} Hz are too few for tau = {tau:g} s")
    total = np.concatenate(([0.0], np.cumsum(samples)))
    second = total[2 * m :] - 2 * total[m:-m] + total[: -2 * m]
    return math.sqrt(float(np.mean(second**2)) / 2) / m
