"""AC and PPO: SB3's A2C and PPO, shown the robot's steps one by one in the order of its loop."""

from math import gcd

import numpy as np
import torch
from stable_baselines3 import A2C, PPO
from stable_baselines3.common.logger import Logger

from controller.action import Action, Observation
from learner.environment.spaces import encoded
from learner.grid import Grid
from learner.interface import State, Transition
from learner.neural import weights
from learner.neural.dice import Dice
from learner.neural.settings import Method, Neural
from learner.neural.shown import Spaces, shown
from learner.tabular.tables import restore

ROLLOUT = {Method.AC: 5, Method.PPO: 256}
"""Steps between updates: SB3's own of A2C; its 2,048 of PPO would be one to ten updates in all."""
_ARRAYS = ("observations", "actions", "rewards", "episode_starts", "values", "log_probs")


class OnPolicyLearner:
    """Fills a rollout, learns from it, forgets it."""

    def __init__(self, grid: Grid, settings: Neural, rng: np.random.Generator) -> None:
        self.grid, self.settings = grid, settings
        self.dice, self.begins = Dice(int(rng.integers(1 << 32))), True
        with self.dice.thrown():
            self.model = model(Spaces(), settings)
        self.model.set_logger(Logger(folder=None, output_formats=[]))
        self.model.policy.set_training_mode(False)
        self.value = self.likelihood = torch.zeros(1)

    def begin(self) -> None:
        """Nothing: the rollout goes on, and marks where episodes begin."""

    def act(self, observation: Observation) -> Action:
        """Drawn from the policy; what it thinks of the pose is kept for the update."""
        seen = encoded(self.grid, observation, forces=False)
        with self.dice.thrown(), torch.no_grad():
            action, self.value, self.likelihood = self.model.policy(torch.from_numpy(seen[None]))
        return Action(int(action))

    def observe(self, transition: Transition) -> None:
        """Into the rollout; an update when it is full."""
        before, action, after, paid, over, cut = shown(self.grid, transition, self.settings)
        income = np.array([paid], np.float32)
        if cut:
            income += (self.settings.gamma * self._worth(after)).numpy()[0]
        rollout = self.model.rollout_buffer
        rollout.add(
            before[None],
            np.array([[action]]),
            income,
            np.array([self.begins]),
            self.value,
            self.likelihood,
        )
        self.begins = over
        if rollout.full:
            rollout.compute_returns_and_advantage(self._worth(after), np.array([over]))
            with self.dice.thrown():
                self.model.train()
            self.model.policy.set_training_mode(False)
            rollout.reset()

    def _worth(self, seen: "np.ndarray[tuple[int], np.dtype[np.float32]]") -> torch.Tensor:
        with self.dice.thrown(), torch.no_grad():
            worth: torch.Tensor = self.model.policy.predict_values(torch.from_numpy(seen[None]))
        return worth

    def grip_changed(self) -> None:
        """Nothing: the net points where it pointed."""

    def save(self) -> State:
        rollout = self.model.rollout_buffer
        return {
            "net": weights.of_net(self.model.policy),
            "optimiser": weights.of_optimiser(self.model.policy.optimizer),
            "rollout": {name: getattr(rollout, name).copy() for name in _ARRAYS},
            "place": np.array([rollout.pos, int(self.begins)]),
            "dice": self.dice.save(),
        }

    def load(self, state: State) -> None:
        """Take up a saved learner; CheckpointError for one of another kind or size."""
        weights.into_net(self.model.policy, state.get("net"))
        weights.into_optimiser(self.model.policy.optimizer, state.get("optimiser"))
        rollout, kept, place = (
            self.model.rollout_buffer,
            state.get("rollout"),
            np.zeros(2, np.int64),
        )
        rollout.reset()
        for name in _ARRAYS:
            restore(name, getattr(rollout, name), weights.part(kept).get(name))
        restore("place", place, state.get("place"))
        rollout.pos, self.begins = int(place[0]), bool(place[1])
        self.dice.load(weights.part(state.get("dice")))


def model(surroundings: Spaces, settings: Neural) -> A2C | PPO:
    """SB3's model with these settings, on one environment."""
    rollout = settings.rollout or ROLLOUT[settings.method]
    shared = {
        "learning_rate": settings.learning_rate,
        "gamma": settings.gamma,
        "n_steps": rollout,
        "policy_kwargs": {"net_arch": [settings.units, settings.units]},
        "device": "cpu",
    }
    if settings.method is Method.AC:
        return A2C("MlpPolicy", surroundings, **shared)
    return PPO("MlpPolicy", surroundings, batch_size=gcd(rollout, 64), **shared)
