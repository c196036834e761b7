"""The policy that the learner's process publishes: one greedy action a pose, with a version.

Two tables take turns; the version says which is whole. The control process reads one byte of it, so
nothing can be torn, and the version it read with never goes back.
"""

import numpy as np
from numpy.typing import NDArray


class PublishedPolicy:
    """version: (1,) uint64. tables: (2, states) uint8, both in shared memory, zeroed."""

    def __init__(self, version: NDArray[np.uint64], tables: NDArray[np.uint8]) -> None:
        self._version, self._tables = version, tables

    @property
    def version(self) -> int:
        """How many have been published; 0 is none."""
        return int(self._version[0])

    def publish(self, actions: NDArray[np.uint8]) -> None:
        """Put a whole table where nobody reads, then point there; the learner's end."""
        following = self.version + 1
        self._tables[following & 1] = actions
        self._version[0] = following

    def action(self, row: int) -> int:
        """The greedy action of the newest whole table; the control process's end."""
        return int(self._tables[self.version & 1, row])
