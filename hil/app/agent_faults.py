"""Faults of a parallel learner: an agent that is gone (L3), a server that is another one (L4).

Apart from the other faults, and imported by runs that learn only: the learner's rules compile.
"""

import numpy as np

from hil.app.host_faults import HostFaults
from hil.cell.faults.injector import Running
from hil.cell.faults.row import Place
from hil.cell.injection.places import OF_A_RUN, OF_A_TRAINING
from learner.interface import Learner
from learner.parallel.agents import Agents
from learner.parallel.server import Model
from learner.parallel.wdql import ParallelLearner


class FaultyPieces:
    """The agents and the server of a learner, asked before each of its choices."""

    def __init__(self, learner: ParallelLearner, faults: HostFaults) -> None:
        self._learner, self._faults = learner, faults

    def fail(self) -> None:
        """Do to them what is in force now."""
        for one in self._faults.of("L3"):
            lose_agent(self._learner, one, self._faults.now)
        self._learner.server.model = self._learner.settings.model
        for one in self._faults.of("L4"):
            lose_server(self._learner, one, self._faults.now)


def pieces(learner: Learner, faults: HostFaults) -> FaultyPieces | None:
    """Of a parallel learner in this process; None of every other one."""
    return FaultyPieces(learner, faults) if isinstance(learner, ParallelLearner) else None


def places(learner: Learner) -> frozenset[Place]:
    """Where a run with this learner can fail."""
    return OF_A_TRAINING if isinstance(learner, ParallelLearner) else OF_A_RUN


def lose_agent(learner: ParallelLearner, one: Running, t: int) -> None:
    """One agent is gone, once; the last one may go too."""
    agents, agent = learner.agents, int(one.fault.number("agent"))
    if one.effect is None and agent < len(agents.steps):
        places, steps = (np.delete(rows, agent, 0) for rows in (agents.places, agents.steps))
        learner.agents = Agents(places, steps, agents.start)
        one.felt(t, f"agent {agent} of {len(agents.steps)} is gone")


def lose_server(learner: ParallelLearner, one: Running, t: int) -> None:
    """The server forgets what it knew (`restart`, once), or judges poses by another model."""
    if one.fault.word("what") == "restart":
        if one.effect is None:
            one.felt(t, f"the server forgets {learner.outcomes.total} outcomes")
            learner.server.restart()
        return
    mine = learner.settings.model
    learner.server.model = next(model for model in Model if model is not mine)
    one.felt(t, f"the server judges by {learner.server.model.value}, the learner by {mine.value}")
