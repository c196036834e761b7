"""DQL: SB3's DQN, shown the robot's steps one by one in the order of its loop."""

import numpy as np
from stable_baselines3 import DQN
from stable_baselines3.common.logger import Logger

from controller.action import Action, Observation
from learner.environment.spaces import encoded
from learner.grid import Grid
from learner.interface import State, Transition
from learner.neural import dice as own
from learner.neural import weights
from learner.neural.settings import Neural
from learner.neural.shown import Spaces, shown
from learner.tabular.tables import restore

BATCH = 32
EVERY = 4
"""Steps between updates, SB3's own."""
MEMORY = 50_000
"""Steps kept: a training has at most 50 episodes of 500."""


class DqlLearner:
    """Updates from batches out of all steps so far."""

    def __init__(self, grid: Grid, settings: Neural, rng: np.random.Generator) -> None:
        self.grid, self.settings = grid, settings
        seed = int(rng.integers(1 << 32))
        self.dice, self.steps = own.Dice(seed), 0
        with self.dice.thrown():
            self.model = model(Spaces(), settings)
        self.model.action_space.seed(seed)
        self.model.exploration_rate = 1.0 - settings.greedy  # the library sets it in its own loop
        self.model.set_logger(Logger(folder=None, output_formats=[]))

    def begin(self) -> None:
        """Nothing: the replay buffer knows no episodes."""

    def act(self, observation: Observation) -> Action:
        """Random while it warms up, then epsilon-greedy."""
        if self.steps < self.settings.warm_up:
            return Action(int(self.model.action_space.sample()))
        with self.dice.thrown():
            chosen, _ = self.model.predict(encoded(self.grid, observation, forces=False))
        return Action(int(chosen))

    def observe(self, transition: Transition) -> None:
        """Into the replay buffer; then the target net's turn, then an update."""
        before, action, after, paid, over, cut = shown(self.grid, transition, self.settings)
        self.model.replay_buffer.add(
            before,
            after,
            np.array([action]),
            np.array([paid], np.float32),
            np.array([over]),
            [{"TimeLimit.truncated": cut}],
        )
        self.steps += 1
        if self.steps % self.settings.renewal == 0:
            self.model.q_net_target.load_state_dict(self.model.q_net.state_dict())
        if self.steps > self.settings.warm_up and self.steps % EVERY == 0:
            with self.dice.thrown():
                self.model.train(gradient_steps=1, batch_size=BATCH)

    def grip_changed(self) -> None:
        """Nothing: the net points where it pointed."""

    def save(self) -> State:
        memory = self.model.replay_buffer
        return {
            "net": weights.of_net(self.model.policy),
            "optimiser": weights.of_optimiser(self.model.policy.optimizer),
            "memory": {name: getattr(memory, name).copy() for name in _ARRAYS},
            "place": np.array([self.steps, memory.pos, int(memory.full)]),
            "dice": self.dice.save(),
            "actions": own.saved(self.model.action_space.np_random.bit_generator),
        }

    def load(self, state: State) -> None:
        """Take up a saved learner; CheckpointError for one of another kind or size."""
        weights.into_net(self.model.policy, state.get("net"))
        weights.into_optimiser(self.model.policy.optimizer, state.get("optimiser"))
        memory, kept, place = self.model.replay_buffer, state.get("memory"), np.zeros(3, np.int64)
        for name in _ARRAYS:
            restore(name, getattr(memory, name), weights.part(kept).get(name))
        restore("place", place, state.get("place"))
        self.steps, memory.pos, memory.full = int(place[0]), int(place[1]), bool(place[2])
        self.dice.load(weights.part(state.get("dice")))
        own.take_up(self.model.action_space.np_random.bit_generator, state.get("actions"))


_ARRAYS = ("observations", "next_observations", "actions", "rewards", "dones", "timeouts")


def model(surroundings: Spaces, settings: Neural) -> DQN:
    """SB3's model with these settings, on one environment."""
    return DQN(
        "MlpPolicy",
        surroundings,
        learning_rate=settings.learning_rate,
        gamma=settings.gamma,
        buffer_size=MEMORY,
        learning_starts=settings.warm_up,
        batch_size=BATCH,
        train_freq=EVERY,
        target_update_interval=settings.renewal,
        exploration_initial_eps=1.0 - settings.greedy,
        exploration_final_eps=1.0 - settings.greedy,
        policy_kwargs={"net_arch": [settings.units, settings.units]},
        device="cpu",
    )
