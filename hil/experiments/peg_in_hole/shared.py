"""The second reading of Fig. 4: n robots in lockstep, each on the true world, one pool of tables.

Nothing is simulated and no parameter server guesses rewards. Reported are the first robot's steps;
the others take as many beside it.
"""

from collections.abc import Iterator

import numpy as np

from controller.outcome import Kind
from learner.grid import Grid
from learner.parallel.agents import Agents
from learner.parallel.outcomes import FAIL, SUCCESS, Classes
from learner.tabular.settings import Tabular
from learner.tabular.tables import empty
from learner.worlds.evaluate import Result
from learner.worlds.slot import SlotWorld

MAX_STEPS = 20_000
"""k_max here: with 500 hardly any episode of an untrained table ends at the goal."""


def train(
    world: SlotWorld, settings: Tabular, agents: int, episodes: int, rng: np.random.Generator
) -> Iterator[Result]:
    """The first robot's episodes. An episode of k_max steps counts as one that never got there."""
    robots = Agents.at((0, 0, 0), agents)
    pool = empty(world.grid.states, agents, rng)
    classes = truth(world.grid, world)
    number = steps = 0
    while number < episodes:
        robots.run(pool, world.grid, classes, settings, rounds=1)
        steps += 1
        if robots.steps[0] == 0:
            number += 1
            kind = Kind.INSERTED if steps < settings.max_steps else Kind.LIMIT
            yield Result(number, 1, kind, steps)
            steps = 0


def truth(grid: Grid, world: SlotWorld) -> Classes:
    """Which poses succeed, (states,)."""
    cells = np.array([grid.at(row) for row in range(grid.states)])
    near = np.abs(cells - world.slot) <= world.model.capture
    classes: Classes = np.where(near.all(axis=1), SUCCESS, FAIL).astype(np.int8)
    return classes
