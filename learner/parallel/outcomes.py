"""What the real robot met at each pose: the data that the parameter server is trained on."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from controller.outcome import Kind
from learner.interface import State
from learner.tabular.tables import restore

FAIL: Final = 0
SUCCESS: Final = 1
DANGER: Final = 2
CLASSES: Final = 3

Classes = NDArray[np.int8]


class Outcomes:
    """counts: how often each pose was fail, success, danger, (states, 3). last: the newest, -1 for
    a pose never seen. An episode that ran out of steps ends at a pose that failed, no worse.
    """

    def __init__(self, states: int) -> None:
        self.counts: NDArray[np.int64] = np.zeros((states, CLASSES), np.int64)
        self.last: Classes = np.full(states, -1, np.int8)

    def note(self, row: int, ending: Kind | None) -> None:
        """The robot reached the pose of this row, and the episode ended so or goes on."""
        label = {Kind.INSERTED: SUCCESS, Kind.DANGER: DANGER}.get(ending or Kind.LIMIT, FAIL)
        self.counts[row, label] += 1
        self.last[row] = label

    @property
    def successes(self) -> int:
        """N_rel of Algorithm 1."""
        return int(self.counts[:, SUCCESS].sum())

    @property
    def total(self) -> int:
        """How many were noted."""
        return int(self.counts.sum())

    def save(self) -> State:
        return {"counts": self.counts.copy(), "last": self.last.copy()}

    def load(self, state: State) -> None:
        """Take up saved outcomes; CheckpointError when they are of another box."""
        restore("counts", self.counts, state.get("counts"))
        restore("last", self.last, state.get("last"))
