"""The numbers of the neural learners; the paper gives one of them, a learning rate of 0.01."""

from dataclasses import dataclass
from enum import Enum


class Method(Enum):
    """DQL: SB3's DQN. AC: its A2C. PPO: its PPO. PG: REINFORCE, which it does not have."""

    DQL = "dql"
    AC = "ac"
    PG = "pg"
    PPO = "ppo"


@dataclass(frozen=True, slots=True)
class Neural:
    """learning_rate, gamma: the paper's. units: of each of two hidden layers.

    greedy: probability of DQL's best action, the paper's epsilon. warm_up: its random steps before
    it learns. renewal: steps between copies of its net to the target net. rollout: steps between
    two updates of AC and PPO, 0 for the library's own (5) and 256. What is not here is the
    library's own default. max_steps: k_max.
    """

    method: Method
    learning_rate: float = 0.01
    gamma: float = 0.9
    units: int = 64
    greedy: float = 0.85
    warm_up: int = 100
    renewal: int = 100
    rollout: int = 0
    max_steps: int = 500

    def __post_init__(self) -> None:
        if not self.learning_rate > 0.0:
            raise ValueError(f"learning_rate must be positive, found {self.learning_rate}")
        if not 0.0 <= self.gamma < 1.0:
            raise ValueError(f"gamma must be in [0, 1), found {self.gamma}")
        if not 0.0 <= self.greedy <= 1.0:
            raise ValueError(f"greedy is a probability, found {self.greedy}")
        if min(self.units, self.renewal, self.max_steps) < 1 or min(self.warm_up, self.rollout) < 0:
            raise ValueError(f"units, renewal and max_steps begin at 1, the others at 0; {self}")
