"""What every neural learner shares: how it is shown a step, and a model's empty surroundings."""

from typing import NamedTuple

import gymnasium
import numpy as np

from controller.outcome import Kind
from learner.environment.spaces import Seen, actions, encoded, observations
from learner.grid import Grid
from learner.interface import Transition
from learner.neural.settings import Neural
from learner.task import reward


class Step(NamedTuple):
    """One transition as a net is shown it. over: success, danger or limit. cut: the limit, after
    which SB3 counts on what the state is worth, since k is no part of it.
    """

    before: Seen
    action: int
    after: Seen
    paid: float
    over: bool
    cut: bool


def shown(grid: Grid, transition: Transition, settings: Neural) -> Step:
    """The same numbers that the gymnasium environment gives for this step."""
    before, after = (
        encoded(grid, seen, forces=False) for seen in (transition.before, transition.after)
    )
    ending = transition.ending
    paid = 0.0 if ending is None else reward(ending, transition.step, settings.max_steps)
    over, cut = ending is not None, ending is Kind.LIMIT
    return Step(before, int(transition.action), after, paid, over, cut)


class Spaces(gymnasium.Env[Seen, np.int64]):
    """Spaces for a model that is shown its steps instead of taking them from an environment."""

    def __init__(self) -> None:
        self.observation_space = observations(forces=False)
        self.action_space = actions()
