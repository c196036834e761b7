"""What is compared: a learner by name and, where it has simulated agents, how many."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from learner.build import maker
from learner.errors import UnknownLearnerError
from learner.interface import Learner
from learner.tabular.settings import Rule, Tabular
from learner.worlds.interface import World

GAMMA = 0.85
"""Section 2's discount; the other worlds keep Section 4's."""


class Contender(NamedTuple):
    """agents: of `wdql` and of the shared tables; 0 for a learner that has none."""

    learner: str
    agents: int = 0

    @property
    def label(self) -> str:
        return f"{self.learner} n={self.agents}" if self.agents else self.learner


def shared() -> Mapping[str, Rule]:
    """Names of the second reading of Fig. 4: n robots, each on the true gridworld, one pool."""
    return {"shared-ql": Rule.SINGLE, "shared-wdql": Rule.WEIGHTED}


def contenders(names: tuple[str, ...], agents: tuple[int, ...]) -> tuple[Contender, ...]:
    """Each name, those with agents once for each number; UnknownLearnerError."""
    found: list[Contender] = []
    for name in names:
        if name == "wdql" or name in shared():
            found += [Contender(name, count) for count in agents]
        else:
            _check(name)
            found.append(Contender(name))
    return tuple(dict.fromkeys(found))


def _check(name: str) -> None:
    try:
        maker(name)
    except UnknownLearnerError as error:
        raise UnknownLearnerError(f"{error}; in this experiment also {', '.join(shared())}") from (
            None
        )


def made(contender: Contender, world: World, gamma: float, rng: np.random.Generator) -> Learner:
    """The learner for a world; gamma: discount of those that have the paper's."""
    # Imported here: compiling the rules takes a second that --help need not wait for.
    from learner.parallel.wdql import Parallel, ParallelLearner  # noqa: PLC0415
    from learner.tabular.alone import TabularLearner  # noqa: PLC0415

    name, agents = contender
    alone = {"ql": Rule.SINGLE, "double-ql": Rule.DOUBLE, "wdql-alone": Rule.WEIGHTED}
    if name == "wdql":
        tabular = Tabular(gamma=gamma, max_steps=world.max_steps)
        return ParallelLearner(world.grid, Parallel(tabular, agents), rng)
    if name in alone:
        tabular = Tabular(alone[name], gamma=gamma, max_steps=world.max_steps)
        return TabularLearner(world.grid, tabular, rng)
    return maker(name)(world.grid, world.max_steps, rng)
