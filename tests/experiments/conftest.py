"""Hand-made truths for the referee: what it watches of a run, and no run."""

from types import SimpleNamespace

import numpy as np
import pytest

from hil.cell.plant.interface import Contact, PartTruth, PlantStep
from hil.experiments.referee import Referee
from hil_fixtures.testbed import shipped

PERIOD = 8_000_000


class Watched:
    """A referee and the run that it is shown, period by period."""

    def __init__(self):
        self.referee = Referee(shipped("ffc_ur5"))
        self._t = 0

    def period(self, phase="search", *, name="FFC1", tip=(0.0, 0.0), depth=0.0, force=(0.0, 0.0)):
        """force: true lateral force of every sample, or one row a sample, N."""
        self._t += PERIOD
        wrenches = np.zeros((8, 6))
        wrenches[:, :2] = force
        part = PartTruth(name, (*tip, -depth), 0.0, depth, (0.0,) * 3, Contact.SLOT)
        truth = PlantStep(wrenches, (0.0,) * 4, (0.0,) * 4, part)
        cycle, course = SimpleNamespace(t=self._t), SimpleNamespace(name=phase)
        self.referee.watch(cycle, course, SimpleNamespace(truth=lambda: truth))


@pytest.fixture
def watched():
    return Watched()
