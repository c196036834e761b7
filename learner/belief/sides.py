"""What the force's sign says of the side on which the slot lies.

Off unless a plant was measured to show it: a wrong sign costs more than none.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controller.action import Observation
from learner.grid import Cell

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Sides:
    """right: chance that the sign of fx, fy, tau_z is that of the way to the slot along x, y,
    theta; 0.5 says nothing, less than 0.5 that it points away. reach: steps within which it does.
    """

    right: tuple[float, float, float]
    reach: int = 3

    def __post_init__(self) -> None:
        if not all(0.0 < chance < 1.0 for chance in self.right) or self.reach < 1:
            raise ValueError(f"chances lie between 0 and 1 and reach is 1 or more; found {self}")


def likelihood(
    shape: tuple[int, int, int], at: Cell, observation: Observation, sides: Sides
) -> Array:
    """How likely these signs are for a slot at each pose, `at` counted from the box's corner.

    Beyond `reach` along any axis, and along an axis that is met, the sign is a coin's.
    """
    x, y, theta = (
        _along(size, place, force, right)
        for size, place, force, right in zip(
            shape, at, (observation.fx, observation.fy, observation.tau_z), sides.right, strict=True
        )
    )
    told: Array = x[:, None, None] * y[None, :, None] * theta[None, None, :]
    nx, ny, nt = (
        np.abs(np.arange(size) - place) <= sides.reach
        for size, place in zip(shape, at, strict=True)
    )
    return np.where(nx[:, None, None] & ny[None, :, None] & nt[None, None, :], told, 1.0)


def _along(size: int, place: int, force: float, right: float) -> Array:
    """Twice the chance of the force's sign, for a slot at each index of one axis."""
    way = np.sign(np.arange(size) - place) * np.sign(force)
    return np.where(way == 0, 1.0, 2.0 * np.where(way > 0, right, 1.0 - right))
