"""The numbers of a tabular learner, with the paper's as defaults."""

from dataclasses import dataclass
from enum import IntEnum

from learner.tabular.rules import DOUBLE, SINGLE, WEIGHTED, Law


class Rule(IntEnum):
    """How the worth of the next state is estimated."""

    SINGLE = SINGLE
    DOUBLE = DOUBLE
    WEIGHTED = WEIGHTED


@dataclass(frozen=True, slots=True)
class Tabular:
    """psi: learning rate (the paper's psi_1 = psi_2). gamma: discount. c: of Eq. 7.

    greedy: the paper's epsilon, which is the probability of the greedy action, constant: 15 % of
    random steps are what turns a way of 13 cells into its "about 20 steps". max_steps: k_max.
    """

    rule: Rule = Rule.WEIGHTED
    psi: float = 0.01
    gamma: float = 0.9
    greedy: float = 0.85
    c: float = 1.0
    max_steps: int = 500
    random_ties: bool = True

    def __post_init__(self) -> None:
        if not 0.0 < self.psi <= 1.0:
            raise ValueError(f"psi must be in (0, 1], found {self.psi}")
        if not 0.0 <= self.gamma < 1.0:
            raise ValueError(f"gamma must be in [0, 1), found {self.gamma}")
        if not 0.0 <= self.greedy <= 1.0:
            raise ValueError(f"greedy is a probability, found {self.greedy}")
        if not self.c > 0.0:
            raise ValueError(f"c must be positive, found {self.c}")
        if self.max_steps < 1:
            raise ValueError(f"max_steps must be at least 1, found {self.max_steps}")

    @property
    def law(self) -> Law:
        """The same for the compiled rules."""
        return Law(int(self.rule), self.psi, self.gamma, self.c, self.greedy, self.random_ties)
