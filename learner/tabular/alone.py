"""Q, double Q and weighted double Q-learning on the real robot's own steps, nothing else."""

from typing import NamedTuple

import numpy as np

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.grid import Grid
from learner.interface import State, Transition
from learner.surface import Array, best_q
from learner.tabular.rules import Pool, Step, choose, update
from learner.tabular.settings import Tabular
from learner.tabular.tables import empty, saved, take_up
from learner.task import reward


class Rows(NamedTuple):
    """A transition by the rows of its poses."""

    before: int
    action: int
    after: int
    step: int
    ending: Kind | None


class TabularLearner:
    """One robot, its tables, its dice."""

    def __init__(self, grid: Grid, settings: Tabular, rng: np.random.Generator) -> None:
        self.grid, self.settings = grid, settings
        self.pool = empty(grid.states, 0, rng)

    def begin(self) -> None:
        """Nothing: a table knows no episodes."""

    def act(self, observation: Observation) -> Action:
        """Eq. 5."""
        return best(self.pool, self.grid, self.settings, observation)

    def observe(self, transition: Transition) -> None:
        """Eqs. 4, 6 and 7."""
        learn(self.pool, self.grid, self.settings, transition)

    def grip_changed(self) -> None:
        """Nothing: the tables point where they pointed, as the paper's do."""

    def values(self) -> Array:
        """Largest Q of each pose, (x, y, theta)."""
        return best_q(self.pool, self.grid)

    def save(self) -> State:
        return saved(self.pool)

    def load(self, state: State) -> None:
        take_up(self.pool, state)


def best(pool: Pool, grid: Grid, settings: Tabular, observation: Observation) -> Action:
    """The real robot's next step on the pool."""
    return Action(choose(pool, settings.law, grid.row(grid.cell(observation)), 0))


def learn(pool: Pool, grid: Grid, settings: Tabular, transition: Transition) -> None:
    """One real transition into the pool."""
    learn_rows(pool, settings, rows(grid, transition))


def rows(grid: Grid, transition: Transition) -> Rows:
    """The transition as the tables see it."""
    before, after = (grid.row(grid.cell(o)) for o in (transition.before, transition.after))
    return Rows(before, int(transition.action), after, transition.step, transition.ending)


def learn_rows(pool: Pool, settings: Tabular, met: Rows) -> None:
    """One real step into the pool."""
    before, action, after, step, ending = met
    paid = 0.0 if ending is None else reward(ending, step, settings.max_steps)
    update(pool, settings.law, Step(before, action, after, paid, ending is not None), 0)
