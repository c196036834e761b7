"""How much more dangerous than elsewhere each pose has proved."""

import numpy as np
from numpy.typing import NDArray

from controller.outcome import Kind
from learner.grid import Cell
from learner.interface import State
from learner.tabular.tables import restore

Array = NDArray[np.float64]

TRUST = 20.0
"""Visits that the Beta prior is worth."""


class Hazard:
    """Steps onto each pose and how many of them were a danger, under a Beta prior at `base`."""

    def __init__(self, shape: tuple[int, int, int], base: float) -> None:
        self.base = base
        self.visits: Array = np.zeros(shape)
        self.dangers: Array = np.zeros(shape)

    def note(self, at: Cell, ending: Kind | None) -> None:
        self.visits[at] += 1
        self.dangers[at] += ending is Kind.DANGER

    @property
    def excess(self) -> Array:
        """Mean chance of danger beyond the base rate, never below 0.

        With the plain mean a visited pose looks safer than a new one, and the search never leaves
        the poses it knows: 0 % success in one setting.
        """
        mean = (self.dangers + self.base * TRUST) / (self.visits + TRUST)
        beyond: Array = np.maximum(0.0, mean - self.base)
        return beyond

    def save(self) -> State:
        return {"visits": self.visits.copy(), "dangers": self.dangers.copy()}

    def load(self, state: State) -> None:
        """Take up saved counts; CheckpointError when they are of another box."""
        restore("visits", self.visits, state.get("visits"))
        restore("dangers", self.dangers, state.get("dangers"))
