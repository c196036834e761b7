"""What is compared: a learner by name and, where it has simulated agents, how many."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from learner.build import maker
from learner.errors import UnknownLearnerError
from learner.interface import Learner
from learner.parameters import Value
from learner.tabular.settings import Rule
from learner.worlds.interface import World

GAMMA = 0.85
"""Section 2's discount; the other worlds keep Section 4's."""


PAPERS = ("ql", "double-ql", "wdql-alone", "dql", "ac", "pg", "ppo")
"""Learners of the paper, beside `wdql`."""


class Contender(NamedTuple):
    """agents: of `wdql` and of the shared tables; 0 for the learner's own number, or none. changes:
    of its parameters, by name; more than one are called tuned.
    """

    learner: str
    agents: int = 0
    changes: tuple[tuple[str, Value], ...] = ()

    @property
    def label(self) -> str:
        if len(self.changes) > 1:
            return f"{self.learner} tuned"
        count = f" n={self.agents}" if self.agents else ""
        return self.learner + count + "".join(f", {name} {value}" for name, value in self.changes)


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


def tuned(sets: Mapping[str, Mapping[str, Value]]) -> tuple[Contender, ...]:
    """Each learner with the parameters of a file; LearnerError for a name or value it refuses."""
    for name, values in sets.items():
        maker(name, values)
    # The number of agents is a parameter of the set, if it names one at all.
    return tuple(Contender(name, 0, tuple(values.items())) for name, values in sets.items())


def _check(name: str) -> None:
    try:
        maker(name)
    except UnknownLearnerError as error:
        raise UnknownLearnerError(f"{error}; in this experiment also {', '.join(shared())}") from (
            None
        )


def made(contender: Contender, world: World, gamma: float, rng: np.random.Generator) -> Learner:
    """The learner for a world; gamma: discount of those that have the paper's."""
    changes = {**_paper(contender, gamma), **dict(contender.changes)}
    return maker(contender.learner, changes)(world.grid, world.max_steps, rng)


def _paper(contender: Contender, gamma: float) -> dict[str, Value]:
    """What the world sets in the paper's own methods; the others keep their numbers."""
    name, agents, _ = contender
    if name == "wdql":
        count: dict[str, Value] = {"agents": agents} if agents else {}
        return {"tabular.gamma": gamma, **count}
    return {"gamma": gamma} if name in PAPERS else {}


def ablation() -> tuple[Contender, ...]:
    """Algorithm 1 and what it becomes when one ingredient is left out or exchanged.

    Without simulation the robot learns from its own steps; so it does when the agents keep their
    tables to themselves, hence one row for both.
    """
    whole = Contender("wdql", 6)
    changed: tuple[tuple[str, Value], ...] = (
        ("tabular.rule", "double"), ("tabular.rule", "single"),
        ("tabular.c", 0.01), ("tabular.c", 100.0), ("rounds", 1), ("rounds", 10),
        ("model", "quadratic"), ("model", "linear"), ("tabular.random_ties", False),
    )  # fmt: skip
    others = [Contender("wdql", count) for count in (1, 2, 4)]
    exchanged = [whole._replace(changes=(change,)) for change in changed]
    return (whole, Contender("wdql-alone"), *others, *exchanged)
