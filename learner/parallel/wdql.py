"""Algorithm 1: the paper's parallel learner, on a schedule that repeats.

The agents take a fixed number of steps after each real step and learn into the pool in a fixed
order, so a run depends on its seed alone. Free-running ones, beside a real loop, are `process`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from controller.action import Action, Observation
from learner.errors import CheckpointError
from learner.grid import Grid
from learner.interface import State, Transition
from learner.parallel.agents import Agents
from learner.parallel.outcomes import FAIL, Classes, Outcomes
from learner.parallel.server import Model, Server
from learner.surface import Array, best_q
from learner.tabular.alone import Rows, best, learn_rows, rows
from learner.tabular.rules import greedy
from learner.tabular.settings import Tabular
from learner.tabular.tables import empty, restore, saved, take_up


@dataclass(frozen=True, slots=True)
class Parallel:
    """agents: n. rounds: simulated steps of each after a real step (the paper names none; from
    about 60 steps of all agents on, more change nothing). model: of the parameter server.
    """

    tabular: Tabular = field(default_factory=Tabular)
    agents: int = 6
    rounds: int = 100
    model: Model = Model.LAST

    def __post_init__(self) -> None:
        if self.agents < 0 or self.rounds < 0:
            raise ValueError(f"agents and rounds cannot be negative, found {self}")


class ParallelLearner:
    """The real robot's thread of Algorithm 1 with its pool, its server and its agents.

    refused: evaluations that were not learnt from, since another model had made them. restarts: of
    the server, seen by its knowing of fewer outcomes than it had been told.
    """

    def __init__(
        self,
        grid: Grid,
        settings: Parallel,
        rng: np.random.Generator,
        start: tuple[int, int, int] = (0, 0, 0),
    ) -> None:
        """start: cell at which simulated episodes begin, where the real ones do."""
        self.grid, self.settings = grid, settings
        self.pool = empty(grid.states, settings.agents, rng)
        self.server = Server(settings.model, grid)
        self.agents = Agents.at(start, settings.agents)
        self.classes: Classes = np.full(grid.states, FAIL, np.int8)
        self.refused = self.restarts = self._told = 0
        self._matches = True

    @property
    def outcomes(self) -> Outcomes:
        """What the server knows of the real robot's poses."""
        return self.server.outcomes

    def begin(self) -> None:
        """Nothing: agents and robot keep their own episodes."""

    def act(self, observation: Observation) -> Action:
        """Eq. 5 on the shared tables."""
        return best(self.pool, self.grid, self.settings.tabular, observation)

    def observe(self, transition: Transition) -> None:
        """Learn from the real step, tell the server, let the agents go on."""
        self.take_in(rows(self.grid, transition))
        self.simulate(self.settings.rounds)

    def take_in(self, met: Rows) -> None:
        """One real step into the pool and the server."""
        learn_rows(self.pool, self.settings.tabular, met)
        self._tell(met)
        if met.ending is not None or self.settings.model is Model.LAST:
            self._evaluate()

    def simulate(self, rounds: int) -> bool:
        """Let each agent take so many steps; False before the first real success, and as long as
        the server judges by another model than this learner's.

        "if N_rel = 1" of Algorithm 1 is read as "from the first success on".
        """
        if not (self.outcomes.successes and self._matches):
            return False
        self.agents.run(self.pool, self.grid, self.classes, self.settings.tabular, rounds)
        return True

    def greedy(self) -> NDArray[np.uint8]:
        """The best action of each pose, ties drawn by the robot's dice, (states,)."""
        return greedy(self.pool, self.settings.tabular.law)

    def values(self) -> Array:
        """Largest Q of each pose, (x, y, theta)."""
        return best_q(self.pool, self.grid)

    def _tell(self, met: Rows) -> None:
        """The server hears of the step; one that has forgotten the others is a new one."""
        if self.outcomes.total < self._told:
            self.restarts += 1
            self.classes[:] = FAIL
        self.outcomes.note(met.after, met.ending)
        self._told = self.outcomes.total

    def _evaluate(self) -> None:
        """Take up the server's evaluation, unless it would be another model's."""
        self._matches = self.server.model is self.settings.model
        if not self._matches:
            self.refused += 1
            return
        classes = self.server.answer()
        if classes is not None:
            self.classes = classes

    def grip_changed(self) -> None:
        """Nothing: the paper's tables point where they pointed."""

    def save(self) -> State:
        return {
            "pool": saved(self.pool),
            "outcomes": self.outcomes.save(),
            "agents": self.agents.save(),
            "classes": self.classes.copy(),
            "told": self._told,
            "matches": int(self._matches),
        }

    def load(self, state: State) -> None:
        """Take up a saved learner; CheckpointError for one of another kind or size."""
        take_up(self.pool, part(state, "pool"))
        self.outcomes.load(part(state, "outcomes"))
        self._told = number(state, "told", self.outcomes.total)
        self._matches = bool(number(state, "matches", 1))
        self.agents.load(part(state, "agents"))
        restore("classes", self.classes, state.get("classes"))


def part(state: State, name: str) -> State:
    """A saved part; CheckpointError when there is none."""
    found = state.get(name)
    if not isinstance(found, Mapping):
        raise CheckpointError(f"no '{name}' in it: not a parallel learner's")
    return found


def number(state: State, name: str, otherwise: int) -> int:
    """A saved count; checkpoints from before it was kept have none."""
    found = state.get(name, otherwise)
    if not isinstance(found, int):
        raise CheckpointError(f"'{name}' is {found!r}, expected a whole number")
    return found
