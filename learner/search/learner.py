"""Goes to the nearest pose not yet tried; once it knows a slot, around where that was."""

import numpy as np
from numpy.typing import NDArray

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.grid import Cell, Grid
from learner.interface import State, Transition
from learner.search.settings import Search
from learner.tabular.dice import below, words
from learner.tabular.tables import restore

_CENTRE = 1e-3
"""Between poses equally near, the one nearer the box's middle."""


class SearchLearner:
    """tried: poses met since the last insertion, or in this episode once there was one.

    slot: where the last insertion was, counted from the box's corner; -1 before the first.
    """

    def __init__(self, grid: Grid, settings: Search, rng: np.random.Generator) -> None:
        self.grid, self.settings = grid, settings
        self.tried: NDArray[np.bool_] = np.zeros(grid.states, np.bool_)
        self.slot: NDArray[np.int64] = np.full(3, -1)
        self.dice = words(rng, 1)
        self._poses: NDArray[np.int64] = np.indices(grid.shape).reshape(3, -1)
        self._off_middle = np.abs(self._poses - np.array([grid.halves]).T).sum(axis=0)

    def begin(self) -> None:
        if self._found:
            self.tried[:] = False

    def act(self, observation: Observation) -> Action:
        here = self._place(self.grid.cell(observation))
        target = self._target(here)
        if target is None:
            self.tried[:] = False
            return Action(below(self.dice, 0, len(Action)))
        way = target - here
        axis = int(np.argmax(np.abs(way)))
        return Action(2 * axis + int(way[axis] < 0))

    def observe(self, transition: Transition) -> None:
        cell = self.grid.cell(transition.after)
        self.tried[self.grid.row(cell)] = True
        if transition.ending is Kind.INSERTED:
            self.slot[:] = self._place(cell)
            self.tried[:] = False

    def grip_changed(self) -> None:
        """Nothing: the slot moved by little, so the search around its last place goes on."""

    @property
    def _found(self) -> bool:
        return bool(self.slot[0] >= 0)

    def _target(self, here: NDArray[np.int64]) -> NDArray[np.int64] | None:
        """The cheapest pose not tried, other than this one; None when there is none left."""
        way = np.abs(self._poses - here[:, None]).sum(axis=0)
        cost = self._cost(way)
        cost[self.tried | (way == 0)] = np.inf
        best = int(np.argmin(cost))
        return None if np.isinf(cost[best]) else self._poses[:, best]

    def _cost(self, way: NDArray[np.int64]) -> NDArray[np.float64]:
        cost: NDArray[np.float64]
        if not self._found:
            cost = way + _CENTRE * self._off_middle
            return cost
        x, y, turn = np.abs(self._poses - self.slot[:, None])
        cost = x + y + self.settings.turn * turn + self.settings.way * way
        return cost

    def _place(self, cell: Cell) -> NDArray[np.int64]:
        """The pose, counted from the box's corner."""
        place: NDArray[np.int64] = np.add(cell, self.grid.halves)
        return place

    def save(self) -> State:
        return {"tried": self.tried.copy(), "slot": self.slot.copy(), "dice": self.dice.copy()}

    def load(self, state: State) -> None:
        """Take up a saved learner; CheckpointError for one of another kind or box."""
        for name in ("tried", "slot", "dice"):
            restore(name, getattr(self, name), state.get(name))
