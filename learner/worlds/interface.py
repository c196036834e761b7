"""What a world is: the search task as a learner meets it, a call a step."""

from typing import NamedTuple, Protocol

import numpy as np

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.grid import Grid


class Met(NamedTuple):
    """What a step led to; ending: INSERTED, DANGER or LIMIT, None while the episode goes on."""

    observation: Observation
    ending: Kind | None


class World(Protocol):
    """One cell: where its slot is, how the part lies in the jaws, what a step does."""

    @property
    def grid(self) -> Grid:
        """Poses of its search box."""
        ...

    @property
    def max_steps(self) -> int:
        """k_max."""
        ...

    def reset(self, rng: np.random.Generator) -> None:
        """A cell and a grip of their own; everything random from here on is drawn from `rng`."""
        ...

    def regrip(self) -> None:
        """The jaws take another part: it lies otherwise in them."""
        ...

    def begin(self) -> Observation:
        """An episode begins, in contact at the start pose."""
        ...

    def step(self, action: Action) -> Met:
        """One step; ValueError after an episode's end."""
        ...
