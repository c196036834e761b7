"""The simulated agents: n walkers on the kinematic grid, one loop, in a fixed order.

Algorithm 1 starts them as threads. Only the number of simulated steps a real step matters, and six
Python threads miss 92 % of the deadlines of a 125 Hz loop beside them: here n is a number.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from learner.grid import Grid
from learner.interface import State
from learner.parallel.outcomes import DANGER, SUCCESS, Classes
from learner.tabular.rules import Law, Pool, Step, choose, update
from learner.tabular.settings import Tabular
from learner.tabular.tables import restore

Ints = NDArray[np.int64]


class Box(NamedTuple):
    """The simulated task: what each pose is held for, half widths, start cell, k_max."""

    classes: Classes
    halves: Ints
    start: Ints
    max_steps: int


@dataclass(slots=True)
class Agents:
    """places: cell of each, (n, 3). steps: of its episode so far, (n,). start: where all begin."""

    places: Ints
    steps: Ints
    start: Ints

    @classmethod
    def at(cls, start: tuple[int, int, int], count: int) -> "Agents":
        """So many agents at the start pose."""
        begin = np.array(start, np.int64)
        return cls(np.tile(begin, (count, 1)), np.zeros(count, np.int64), begin)

    def run(self, pool: Pool, grid: Grid, classes: Classes, settings: Tabular, rounds: int) -> None:
        """So many steps of each agent, in turn, each learning into the pool at once."""
        box = Box(classes, np.array(grid.halves), self.start, settings.max_steps)
        walk(pool, settings.law, box, self.places, self.steps, rounds)

    def save(self) -> State:
        return {"places": self.places.copy(), "steps": self.steps.copy()}

    def load(self, state: State) -> None:
        """Take up saved agents, of whom some may be gone; CheckpointError for too many."""
        found = state.get("steps")
        left = len(found) if isinstance(found, np.ndarray) and found.ndim else len(self.steps)
        self.places, self.steps = self.places[:left].copy(), self.steps[:left].copy()
        restore("places", self.places, state.get("places"))
        restore("steps", self.steps, found)


@njit(cache=True)
def walk(pool: Pool, law: Law, box: Box, places: Ints, steps: Ints, rounds: int) -> None:  # noqa: PLR0917
    """Rounds of one step an agent; agent i draws from word i + 1."""
    for _ in range(rounds):
        for i in range(len(steps)):
            place = places[i]
            before = _row(place, box.halves)
            action = choose(pool, law, before, i + 1)
            _move(place, action, box.halves)
            steps[i] += 1
            after = _row(place, box.halves)
            paid, over = _paid(box.classes[after], steps[i], box.max_steps)
            update(pool, law, Step(before, action, after, paid, over), i + 1)
            if over:
                place[:] = box.start
                steps[i] = 0


@njit(cache=True)
def _row(place: Ints, halves: Ints) -> int:
    ny, nt = 2 * halves[1] + 1, 2 * halves[2] + 1
    row: int = ((place[0] + halves[0]) * ny + place[1] + halves[1]) * nt + place[2] + halves[2]
    return row


@njit(cache=True)
def _move(place: Ints, action: int, halves: Ints) -> None:
    """One step; the box's edge stops it."""
    axis = action >> 1
    moved = place[axis] + (1 - 2 * (action & 1))
    if abs(moved) <= halves[axis]:
        place[axis] = moved


@njit(cache=True)
def _paid(label: int, step: int, max_steps: int) -> tuple[float, bool]:
    """Reward of Eq. 4 and whether the episode is over: danger, then success, then the limit."""
    if label == DANGER:
        return -1.0, True
    if label == SUCCESS:
        return 1.0 - step / max_steps, True
    if step >= max_steps:
        return -0.5, True
    return 0.0, False
