"""From a learner's name to a learner."""

from collections.abc import Callable, Mapping
from difflib import get_close_matches
from functools import partial
from importlib import import_module
from typing import TypeAlias

import numpy as np

from learner.errors import UnknownLearnerError
from learner.grid import Grid
from learner.interface import Learner

Maker: TypeAlias = Callable[[Grid, int, np.random.Generator], Learner]
"""Called with the search box, k_max and the learner's own generator."""


def learners() -> Mapping[str, Maker]:
    """The learners of this package by name.

    ql, double-ql, wdql-alone: the robot's own steps only. wdql: the paper's Algorithm 1, n = 6.
    belief: plans on what it believes of the slot. search: search and memory, no learning.
    """
    # Imported here: compiling the rules takes a second that nothing else needs to wait for.
    from learner.belief.learner import BeliefLearner  # noqa: PLC0415
    from learner.belief.settings import Belief  # noqa: PLC0415
    from learner.parallel.wdql import Parallel, ParallelLearner  # noqa: PLC0415
    from learner.search.learner import SearchLearner  # noqa: PLC0415
    from learner.tabular.alone import TabularLearner  # noqa: PLC0415
    from learner.tabular.settings import Rule, Tabular  # noqa: PLC0415

    def alone(rule: Rule, grid: Grid, max_steps: int, rng: np.random.Generator) -> Learner:
        return TabularLearner(grid, Tabular(rule=rule, max_steps=max_steps), rng)

    def parallel(grid: Grid, max_steps: int, rng: np.random.Generator) -> Learner:
        return ParallelLearner(grid, Parallel(Tabular(max_steps=max_steps)), rng)

    def belief(grid: Grid, max_steps: int, rng: np.random.Generator) -> Learner:
        return BeliefLearner(grid, Belief(), rng)

    def search(grid: Grid, max_steps: int, rng: np.random.Generator) -> Learner:
        return SearchLearner(grid, rng)

    return {
        "belief": belief,
        "ql": partial(alone, Rule.SINGLE),
        "double-ql": partial(alone, Rule.DOUBLE),
        "wdql-alone": partial(alone, Rule.WEIGHTED),
        "wdql": parallel,
        "search": search,
    }


def maker(name: str) -> Maker:
    """What makes a learner of this name; `package.module:Class` is one of your own, made from the
    same three arguments. Raises UnknownLearnerError.
    """
    known = learners()
    if name in known:
        return known[name]
    if ":" not in name:
        near = get_close_matches(name, known, 1)
        hint = f"did you mean '{near[0]}'? " if near else ""
        raise UnknownLearnerError(
            f"no learner '{name}'; {hint}there are {', '.join(known)}, or package.module:Class"
        )
    module, _, attribute = name.partition(":")
    try:
        found: Maker = getattr(import_module(module), attribute)
    except (ImportError, AttributeError, ValueError) as error:
        raise UnknownLearnerError(f"learner '{name}' cannot be imported: {error}") from error
    return found
