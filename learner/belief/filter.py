"""Bayes' filter over the pose at which the part goes in, in the robot's frame.

All arrays are (x, y, theta) of the box; poses count from its corner. Each function returns a new
belief whose sum is 1 and which rules no pose out.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import correlate1d, uniform_filter1d  # type: ignore[attr-defined]

from learner.grid import Cell

Array = NDArray[np.float64]

_BLUNDER = 1e-12
"""Chance of an insertion where the kernel allows none: keeps every pose possible."""


def unknown(shape: tuple[int, int, int]) -> Array:
    """Any pose of the box may be it."""
    belief: Array = np.full(shape, 1.0 / np.prod(shape))
    return belief


def going_in(shape: tuple[int, int, int], at: Cell, kernel: Array) -> Array:
    """Chance that the part goes in here, for a slot at each pose; kernel by distance an axis."""
    x, y, theta = (_along(size, place, kernel) for size, place in zip(shape, at, strict=True))
    chance: Array = x[:, None, None] * y[None, :, None] * theta[None, None, :]
    return chance


def inserted(belief: Array, chance: Array) -> Array:
    """After the part went in; `chance` of `going_in` at that pose."""
    return _whole(belief * chance + _BLUNDER)


def missed(belief: Array, chance: Array) -> Array:
    """After it did not."""
    return _whole(belief * (1.0 - chance))


def told(belief: Array, likelihood: Array) -> Array:
    """After evidence of any other kind."""
    return _whole(belief * likelihood)


def drifted(belief: Array, drift: float, floor: float) -> Array:
    """The slot may have moved by a step along each axis; `floor` of the belief goes anywhere.

    Reflected at the box's edge: the slot stays in the box, and the belief's entropy never falls.
    """
    kernel = np.array([drift / 2, 1.0 - drift, drift / 2])
    for axis in range(3):
        belief = correlate1d(belief, kernel, axis=axis, mode="reflect")
    return _floored(belief, floor)


def widened(belief: Array, clearance: tuple[int, int, int], floor: float) -> Array:
    """The part lies otherwise in the jaws, by up to so many steps along each axis."""
    for axis, steps in enumerate(clearance):
        belief = uniform_filter1d(belief, 2 * steps + 1, axis=axis, mode="reflect")
    return _floored(belief, floor)


def success(belief: Array, kernel: Array) -> Array:
    """Chance at each pose that the part goes in there."""
    both_ways = np.concatenate([kernel[:0:-1], kernel])
    for axis in range(3):
        belief = correlate1d(belief, both_ways, axis=axis, mode="constant")
    return belief


def _along(size: int, place: int, kernel: Array) -> Array:
    """The kernel laid around a place of one axis."""
    chance = np.zeros(size)
    for distance, value in enumerate(kernel):
        for index in {place - distance, place + distance}:
            if 0 <= index < size:
                chance[index] = value
    return chance


def _floored(belief: Array, floor: float) -> Array:
    mixed: Array = (1.0 - floor) * belief / belief.sum() + floor / belief.size
    return mixed


def _whole(belief: Array) -> Array:
    scaled: Array = belief / belief.sum()
    return scaled
