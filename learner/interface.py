"""What a learner is: one class that acts, observes, and can be saved and loaded."""

from collections.abc import Mapping
from typing import NamedTuple, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from controller.action import Action, Observation
from controller.outcome import Kind

State: TypeAlias = Mapping[str, "NDArray[np.generic] | float | int | str | State"]
"""All that a learner remembers, generators included: arrays, numbers, text, mappings of them."""


class Transition(NamedTuple):
    """One step of an episode.

    step: its number, from 1. ending: None while the episode goes on, else how it ended: INSERTED,
    DANGER or LIMIT.
    """

    before: Observation
    action: Action
    after: Observation
    step: int
    ending: Kind | None


class Learner(Protocol):
    """Chooses search steps and learns from what they lead to.

    The same calls in the same order give the same actions: randomness is a generator of its own.
    """

    def begin(self) -> None:
        """An episode begins with the part in contact at the start pose."""
        ...

    def act(self, observation: Observation) -> Action:
        """The next step."""
        ...

    def observe(self, transition: Transition) -> None:
        """What the last step led to; called once a step, before the next `act`."""
        ...

    def grip_changed(self) -> None:
        """The jaws took a part anew: it lies elsewhere in them, within the fixture's clearance."""
        ...

    def save(self) -> State:
        """Everything that `load` needs to go on as if there had been no break."""
        ...

    def load(self, state: State) -> None:
        """Take up a saved state; raises CheckpointError for one of another kind or shape."""
        ...


@runtime_checkable
class Checked(Protocol):
    """A learner that asks a server, and counts the answers that it would not learn from."""

    refused: int
