"""PG: REINFORCE (Williams 1992), an update an episode on its discounted returns.

Without a baseline: standardising the returns of each episode by themselves, as is often done,
pushes a success's first steps down and a failure's up, since the only reward comes last.
"""

import numpy as np
import torch
from numpy.typing import NDArray
from torch.distributions import Categorical
from torch.nn import Linear, Sequential, Tanh

from controller.action import Action, Observation
from learner.environment.spaces import POSE, encoded
from learner.grid import Grid
from learner.interface import State, Transition
from learner.neural import weights
from learner.neural.dice import Dice
from learner.neural.settings import Neural
from learner.neural.shown import shown
from learner.tabular.rules import ACTIONS
from learner.tabular.tables import restore

Array = NDArray[np.float64]


class PgLearner:
    """SB3 has no plain policy gradient; this is its net (two layers of tanh) under Adam."""

    def __init__(self, grid: Grid, settings: Neural, rng: np.random.Generator) -> None:
        self.grid, self.settings = grid, settings
        self.dice = Dice(int(rng.integers(1 << 32)))
        seen = POSE
        with self.dice.thrown():
            self.net = Sequential(
                Linear(seen, settings.units), Tanh(),
                Linear(settings.units, settings.units), Tanh(),
                Linear(settings.units, ACTIONS),
            )  # fmt: skip
        self.optimiser = torch.optim.Adam(self.net.parameters(), settings.learning_rate)
        # The episode so far: what was shown, the action taken, what it paid; (max_steps, ...).
        self.seen = np.zeros((settings.max_steps, seen), np.float32)
        self.taken = np.zeros(settings.max_steps, np.int64)
        self.paid = np.zeros(settings.max_steps)
        self.steps = 0

    def begin(self) -> None:
        """An episode that taught nothing to the end is forgotten."""
        self.steps = 0

    def act(self, observation: Observation) -> Action:
        """Drawn from the policy."""
        seen = torch.from_numpy(encoded(self.grid, observation, forces=False))
        with self.dice.thrown(), torch.no_grad():
            return Action(int(Categorical(logits=self.net(seen)).sample()))

    def observe(self, transition: Transition) -> None:
        """Keep the step; learn when the episode is over."""
        before, action, _, paid, over, _ = shown(self.grid, transition, self.settings)
        k = self.steps
        self.seen[k], self.taken[k], self.paid[k] = before, action, paid
        self.steps += 1
        if over:
            with self.dice.thrown():
                self._learn()
            self.steps = 0

    def _learn(self) -> None:
        k = self.steps
        worth = torch.from_numpy(returns(self.paid[:k], self.settings.gamma).astype(np.float32))
        drawn = Categorical(logits=self.net(torch.from_numpy(self.seen[:k])))
        loss = -(drawn.log_prob(torch.from_numpy(self.taken[:k])) * worth).mean()
        self.optimiser.zero_grad()
        loss.backward()
        self.optimiser.step()

    def grip_changed(self) -> None:
        """Nothing: the net points where it pointed."""

    def save(self) -> State:
        return {
            "net": weights.of_net(self.net),
            "optimiser": weights.of_optimiser(self.optimiser),
            "seen": self.seen.copy(),
            "taken": self.taken.copy(),
            "paid": self.paid.copy(),
            "steps": self.steps,
            "dice": self.dice.save(),
        }

    def load(self, state: State) -> None:
        """Take up a saved learner; CheckpointError for one of another kind or size."""
        weights.into_net(self.net, state.get("net"))
        weights.into_optimiser(self.optimiser, state.get("optimiser"))
        for name in ("seen", "taken", "paid"):
            restore(name, getattr(self, name), state.get(name))
        self.steps = int(str(state.get("steps", 0)))
        self.dice.load(weights.part(state.get("dice")))


def returns(paid: Array, gamma: float) -> Array:
    """Eq. 3: from each step on, discounted; (k,)."""
    found, following = np.zeros(len(paid)), 0.0
    for step in range(len(paid) - 1, -1, -1):
        following = found[step] = paid[step] + gamma * following
    return found
