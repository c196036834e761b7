"""Eqs. 5, 6 and 7 of the paper as functions on arrays, compiled.

Weighted double Q-learning: Zhang, Pan and Kochenderfer, IJCAI 2017. `i` is the word of the pool's
dice that a call draws from.
"""

from typing import Final, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from learner.tabular.dice import Words, below, uniform

Table = NDArray[np.float64]

SINGLE: Final = 0
DOUBLE: Final = 1
WEIGHTED: Final = 2
ACTIONS: Final = 6


class Pool(NamedTuple):
    """Two tables of Q, (states, 6), and the random words of all who learn into them."""

    q1: Table
    q2: Table
    dice: Words


class Law(NamedTuple):
    """rule: SINGLE, DOUBLE or WEIGHTED. greedy: probability of the best action (the paper's
    epsilon). random_ties: equal actions are drawn among; else the first is taken.
    """

    rule: int
    psi: float
    gamma: float
    c: float
    greedy: float
    random_ties: bool


class Step(NamedTuple):
    """Rows before and after, the action between, what it paid, whether it ended the episode."""

    before: int
    action: int
    after: int
    paid: float
    over: bool


@njit(cache=True)
def largest(values: Table, law: Law, dice: Words, i: int) -> int:
    """Index of the largest value; equal ones are drawn among.

    Taking the first instead, as a plain argmax does, drives an untrained table along one axis into
    the box's edge: it halves the paper's success rate.
    """
    best, count, chosen = values[0], 1, 0
    for k in range(1, values.shape[0]):
        if values[k] > best:
            best, count, chosen = values[k], 1, k
        elif values[k] == best and law.random_ties:
            count += 1
            if below(dice, i, count) == 0:
                chosen = k
    return chosen


@njit(cache=True)
def choose(pool: Pool, law: Law, row: int, i: int) -> int:
    """Eq. 5: with probability `greedy` the best action of Q1 + Q2, else any of the six."""
    if uniform(pool.dice, i) < law.greedy:
        best: int = largest(pool.q1[row] + pool.q2[row], law, pool.dice, i)
        return best
    any_of_six: int = below(pool.dice, i, ACTIONS)
    return any_of_six


@njit(cache=True)
def weight(best: float, worst: float, c: float) -> float:
    """Eq. 7: how far the own table is trusted, in [0, 1); 0 makes it double Q-learning."""
    gap = abs(best - worst)
    if gap == 0.0:
        return 0.0
    # Beyond gap/c = 2^53 the quotient rounds to 1, which would be plain Q-learning.
    return min(gap / (c + gap), 1.0 - 2.0**-53)


@njit(cache=True)
def worth(own: Table, other: Table, row: int, law: Law, dice: Words, i: int) -> float:  # noqa: PLR0917
    """What a state is worth to the table `own`: the bracket of Eq. 6."""
    best = largest(own[row], law, dice, i)
    mine: float = own[row, best]
    theirs: float = other[row, best]
    if law.rule == SINGLE:
        return mine
    if law.rule == DOUBLE:
        return theirs
    beta: float = weight(theirs, other[row, np.argmin(own[row])], law.c)
    return beta * mine + (1.0 - beta) * theirs


@njit(cache=True)
def update(pool: Pool, law: Law, step: Step, i: int) -> None:
    """Eq. 6 for one step, in place. Of two tables the one to change is drawn."""
    own, other = pool.q1, pool.q2
    if law.rule != SINGLE and uniform(pool.dice, i) < 0.5:
        own, other = pool.q2, pool.q1
    target = step.paid
    if not step.over:
        target += law.gamma * worth(own, other, step.after, law, pool.dice, i)
    own[step.before, step.action] += law.psi * (target - own[step.before, step.action])


@njit(cache=True)
def greedy(pool: Pool, law: Law) -> NDArray[np.uint8]:
    """The best action of Q1 + Q2 in each state, (states,); draws from the first word."""
    actions = np.empty(pool.q1.shape[0], np.uint8)
    for row in range(pool.q1.shape[0]):
        actions[row] = largest(pool.q1[row] + pool.q2[row], law, pool.dice, 0)
    return actions
