"""Faults of whoever chooses the search's steps: stale, corrupt or slow; a learner in pieces."""

from collections import deque
from dataclasses import replace
from typing import Final, cast

import numpy as np

from controller.action import Action, Answer, Observation, Pending, Policy
from hil.app.host_faults import HostFaults
from hil.cell.faults.injector import Running
from learner.interface import Learner, State, Transition
from learner.parallel.agents import Agents
from learner.parallel.outcomes import FAIL, Outcomes
from learner.parallel.server import Model
from learner.parallel.wdql import ParallelLearner

NS: Final = 1_000_000_000
REMEMBERED: Final = 10_000
_WRONG: Final = {"nan": float("nan"), "out_of_range": 17, "none": None}
"""What no action filter may let through. None is an answer, and means giving up."""


class Choosing:
    """What happens between an observation and the action that comes of it (L1, L2, L5)."""

    def __init__(self, faults: HostFaults) -> None:
        self._faults = faults
        self._seen: deque[Observation] = deque(maxlen=REMEMBERED)
        self._asked: int | None = None

    def thinks(self) -> bool:
        """Whether the answer is not there yet; asked once a period."""
        slow, now = self._faults.of("L5"), self._faults.now
        if self._asked is None:
            self._asked = now
        for one in slow:
            one.felt(now, "the choice comes late")
        late = max((round(one.fault.number("delay") * NS) for one in slow), default=0)
        if now - self._asked < late:
            return True
        self._asked = None
        return False

    def seen(self, observation: Observation) -> Observation:
        """What the chooser gets to see."""
        self._seen.append(observation)
        for one in self._faults.of("L1"):
            old = self._seen[-min(len(self._seen), 1 + int(one.fault.number("age")))]
            if old is not observation:
                one.felt(self._faults.now, "chosen by an old observation")
            observation = old
        return observation

    def given(self, action: Answer, observation: Observation) -> Answer:
        """What reaches the controller, whatever its type says."""
        for one in self._faults.of("L2"):
            value = one.fault.word("value")
            wrong = _away(observation) if value == "adversarial" else _WRONG[value]
            one.felt(self._faults.now, f"action {wrong!r}")
            action = cast("Answer", wrong)  # the fault is that it is none
        return action


def _away(observation: Observation) -> Action:
    """The step that leads furthest off the middle."""
    return Action.PLUS_X if observation.x >= 0.0 else Action.MINUS_X


class FaultyPolicy:
    """A policy behind faults."""

    def __init__(self, policy: Policy, faults: HostFaults) -> None:
        self._policy, self._choosing = policy, Choosing(faults)

    def choose(self, observation: Observation) -> Answer:
        if self._choosing.thinks():
            return Pending.PENDING
        chosen = self._policy.choose(self._choosing.seen(observation))
        return self._choosing.given(chosen, observation)


class FaultyLearner:
    """A learner behind faults; those of agents and server (L3, L4) are a parallel learner's."""

    def __init__(self, learner: Learner, faults: HostFaults) -> None:
        self._learner, self._faults, self._choosing = learner, faults, Choosing(faults)
        self._model = learner.settings.model if isinstance(learner, ParallelLearner) else None

    def begin(self) -> None:
        self._learner.begin()

    def act(self, observation: Observation) -> Action:
        chosen = self._learner.act(self._choosing.seen(observation))
        return cast("Action", self._choosing.given(chosen, observation))

    def observe(self, transition: Transition) -> None:
        if isinstance(self._learner, ParallelLearner):
            self._lose(self._learner)
        self._learner.observe(transition)

    def _lose(self, learner: ParallelLearner) -> None:
        for one in self._faults.of("L3"):
            lose_agent(learner, one, self._faults.now)
        wrong = self._faults.of("L4")
        for one in wrong:
            lose_server(learner, one, self._faults.now)
        if not wrong:
            learner.settings = replace(
                learner.settings, model=self._model or learner.settings.model
            )

    def grip_changed(self) -> None:
        self._learner.grip_changed()

    def save(self) -> State:
        return self._learner.save()

    def load(self, state: State) -> None:
        self._learner.load(state)


def lose_agent(learner: ParallelLearner, one: Running, t: int) -> None:
    """One agent is gone, once; the last one may go too."""
    agents, agent = learner.agents, int(one.fault.number("agent"))
    if one.effect is None and agent < len(agents.steps):
        places, steps = (np.delete(rows, agent, 0) for rows in (agents.places, agents.steps))
        learner.agents = Agents(places, steps, agents.start)
        one.felt(t, f"agent {agent} of {len(steps) + 1} is gone")


def lose_server(learner: ParallelLearner, one: Running, t: int) -> None:
    """The server forgets what it knew (`restart`, once), or judges poses by another model."""
    if one.fault.word("what") == "restart":
        if one.effect is None:
            learner.outcomes = Outcomes(learner.grid.states)
            learner.classes = np.full(learner.grid.states, FAIL, np.int8)
            one.felt(t, "the server starts anew")
    elif one.effect is None:
        other = next(model for model in Model if model is not learner.settings.model)
        learner.settings = replace(learner.settings, model=other)
        one.felt(t, f"the server judges by {other.value}")
