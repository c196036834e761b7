"""The one block of shared memory between control and learner, and what lies where in it."""

from multiprocessing.shared_memory import SharedMemory
from typing import Final, NamedTuple, Self

import numpy as np

from learner.beside.policy import PublishedPolicy
from learner.beside.ring import SLOT, Ring

SLOTS: Final = 4096
"""Transitions in flight: at seven steps a second, ten minutes of a learner that hangs."""


class Layout(NamedTuple):
    """What the other process needs to look at the same memory."""

    name: str
    states: int


class Memory:
    """Create it in the control process, `attach` in the learner's; `close` in both."""

    def __init__(self, states: int, block: SharedMemory | None = None) -> None:
        ring, policy = SLOTS * SLOT.itemsize, 8 + 2 * states
        self._owner = block is None
        self._block = block or SharedMemory(create=True, size=ring + policy)
        self._states = states
        buffer = self._block.buf
        assert buffer is not None, "a block that was just opened has its memory"
        self.ring = Ring(np.frombuffer(buffer, SLOT, SLOTS))
        version = np.frombuffer(buffer, np.uint64, 1, ring)
        tables = np.frombuffer(buffer, np.uint8, 2 * states, ring + 8).reshape(2, states)
        self.policy = PublishedPolicy(version, tables)

    @classmethod
    def attach(cls, layout: Layout) -> Self:
        """The learner's end."""
        return cls(layout.states, SharedMemory(layout.name))

    @property
    def layout(self) -> Layout:
        return Layout(self._block.name, self._states)

    def close(self) -> None:
        """Let go of it; the one who made it removes it."""
        del self.ring, self.policy  # views keep the mapping open
        self._block.close()
        if self._owner:
            self._block.unlink()
