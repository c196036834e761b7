"""From a learner's name to a learner."""

from collections.abc import Callable, Mapping
from difflib import get_close_matches
from importlib import import_module
from typing import NamedTuple, TypeAlias

import numpy as np

from learner.errors import LearnerParameterError, UnknownLearnerError
from learner.grid import Grid
from learner.interface import Learner
from learner.neural.build import check_extra, neural
from learner.neural.settings import Method, Neural
from learner.parameters import Value, parameters, with_parameters

Maker: TypeAlias = Callable[[Grid, int, np.random.Generator], Learner]
"""Called with the search box, k_max and the learner's own generator."""


class Named(NamedTuple):
    """settings: with the paper's numbers, or a learner's own. build: from the box, those settings
    and a generator. limit: the parameter that is k_max, "" for a learner that needs none.
    """

    settings: object
    build: Callable[..., Learner]
    limit: str = ""


def learners() -> Mapping[str, Named]:
    """The learners of this package by name.

    ql, double-ql, wdql-alone: the robot's own steps only. wdql: the paper's Algorithm 1, n = 6.
    dql, ac, pg, ppo: neural, with the extra `baselines`.
    belief: plans on what it believes of the slot. search: search and memory, no learning.
    """
    # Imported here: compiling the rules takes a second that nothing else needs to wait for.
    from learner.belief.learner import BeliefLearner  # noqa: PLC0415
    from learner.belief.settings import Belief  # noqa: PLC0415
    from learner.parallel.wdql import Parallel, ParallelLearner  # noqa: PLC0415
    from learner.search.learner import SearchLearner  # noqa: PLC0415
    from learner.search.settings import Search  # noqa: PLC0415
    from learner.tabular.alone import TabularLearner  # noqa: PLC0415
    from learner.tabular.settings import Rule, Tabular  # noqa: PLC0415

    def alone(rule: Rule) -> Named:
        return Named(Tabular(rule), TabularLearner, "max_steps")

    return {
        "belief": Named(Belief(), BeliefLearner),
        "ql": alone(Rule.SINGLE),
        "double-ql": alone(Rule.DOUBLE),
        "wdql-alone": alone(Rule.WEIGHTED),
        "wdql": Named(Parallel(), ParallelLearner, "tabular.max_steps"),
        **{method.value: Named(Neural(method), neural, "max_steps") for method in Method},
        "search": Named(Search(), SearchLearner),
    }


def maker(name: str, values: Mapping[str, Value] | None = None) -> Maker:
    """What makes a learner of this name with these parameters, the others being the paper's.

    `package.module:Class` is one of your own, made from the same three arguments and the parameters
    by keyword. Raises UnknownLearnerError, LearnerParameterError, MissingExtraError.
    """
    chosen = dict(values or {})
    known = learners()
    if name in known:
        return _named(name, known[name], chosen)
    if ":" not in name:
        near = get_close_matches(name, known, 1)
        hint = f"did you mean '{near[0]}'? " if near else ""
        raise UnknownLearnerError(
            f"no learner '{name}'; {hint}there are {', '.join(known)}, or package.module:Class"
        )
    return _own(name, chosen)


def tunable(name: str) -> dict[str, Value]:
    """A named learner's parameters with their defaults; none are known of one of your own."""
    known = learners()
    return parameters(known[name].settings) if name in known else {}


def _named(name: str, named: Named, values: Mapping[str, Value]) -> Maker:
    try:
        settings = with_parameters(named.settings, values)
    except LearnerParameterError as error:
        raise LearnerParameterError(f"learner {name}: {error}") from None
    if isinstance(settings, Neural):
        check_extra(name)

    def make(grid: Grid, max_steps: int, rng: np.random.Generator) -> Learner:
        limit = {named.limit: max_steps} if named.limit else {}
        return named.build(grid, with_parameters(settings, limit), rng)

    return make


def _own(name: str, values: Mapping[str, Value]) -> Maker:
    module, _, attribute = name.partition(":")
    try:
        found: Callable[..., Learner] = getattr(import_module(module), attribute)
    except (ImportError, AttributeError, ValueError) as error:
        raise UnknownLearnerError(f"learner '{name}' cannot be imported: {error}") from error

    def make(grid: Grid, max_steps: int, rng: np.random.Generator) -> Learner:
        return found(grid, max_steps, rng, **values)

    return make
