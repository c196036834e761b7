"""Value iteration on the chances of success and danger, compiled.

The worth of stepping onto pose s, H the excess hazard there and R the chance of going in:
W(s) = -danger H + (1 - H) (R + (1 - R) gamma max over s' next to s of W(s')).
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from learner.grid import Cell
from learner.tabular.dice import Words, below

Array = NDArray[np.float64]

_OUTSIDE = -1e9
"""Far below any worth, and finite: the chance it is multiplied by may be 0."""
_EQUAL = 1e-15


class Plan:
    """Worth of each pose, kept from step to step: few sweeps follow a small change.

    worth: (x + 2, y + 2, theta + 2), with a rim that no step leads to.
    """

    def __init__(self, shape: tuple[int, int, int]) -> None:
        x, y, theta = shape
        self.worth: Array = np.full((x + 2, y + 2, theta + 2), _OUTSIDE)
        self.worth[1:-1, 1:-1, 1:-1] = 0.0

    def forget(self) -> None:
        """Begin from nothing: an old plan's worth may hold by more sweeps than are left."""
        self.worth[1:-1, 1:-1, 1:-1] = 0.0

    def improve(
        self, success: Array, hazard: Array, gamma: float, danger: float, sweeps: int
    ) -> None:
        """So many sweeps, to and fro over the box."""
        gain = (1.0 - hazard) * success - danger * hazard
        carried = (1.0 - hazard) * (1.0 - success) * gamma
        _sweep(self.worth, gain, carried, sweeps)

    def step(self, at: Cell, dice: Words) -> int:
        """The action that leads to the best pose next to `at`; equal ones are drawn among."""
        x, y, theta = at
        chosen: int = _best(_around(self.worth, x + 1, y + 1, theta + 1), dice)
        return chosen


@njit(cache=True)
def _sweep(worth: Array, gain: Array, carried: Array, sweeps: int) -> None:
    """Gauss and Seidel's way: each pose sees what its neighbours have just become."""
    nx, ny, nt = gain.shape
    for sweep in range(sweeps):
        for i in range(nx):
            x = i if sweep % 2 == 0 else nx - 1 - i
            for j in range(ny):
                y = j if sweep % 2 == 0 else ny - 1 - j
                for k in range(nt):
                    t = k if sweep % 2 == 0 else nt - 1 - k
                    best = max(
                        worth[x + 2, y + 1, t + 1],
                        worth[x, y + 1, t + 1],
                        worth[x + 1, y + 2, t + 1],
                        worth[x + 1, y, t + 1],
                        worth[x + 1, y + 1, t + 2],
                        worth[x + 1, y + 1, t],
                    )
                    worth[x + 1, y + 1, t + 1] = gain[x, y, t] + carried[x, y, t] * best


@njit(cache=True)
def _around(worth: Array, x: int, y: int, t: int) -> Array:
    """Worth of the six poses that the actions of Eq. 2 lead to, in their order."""
    near = np.empty(6)
    near[0], near[1] = worth[x + 1, y, t], worth[x - 1, y, t]
    near[2], near[3] = worth[x, y + 1, t], worth[x, y - 1, t]
    near[4], near[5] = worth[x, y, t + 1], worth[x, y, t - 1]
    return near


@njit(cache=True)
def _best(near: Array, dice: Words) -> int:
    chosen, count = 0, 0
    best = np.max(near)
    for action in range(6):
        if near[action] >= best - _EQUAL:
            count += 1
            if below(dice, 0, count) == 0:
                chosen = action
    return chosen
