"""L3 and L4: what is left of a parallel learner goes on, and learns only from its own model."""

import numpy as np
import pytest

from controller.action import Action, Observation
from controller.outcome import Kind
from hil.app.agent_faults import lose_agent, lose_server
from hil.cell.faults.injector import FOREVER, Running
from hil.cell.faults.schedule import Fault
from learner.grid import Grid
from learner.interface import Transition
from learner.parallel.server import Model
from learner.parallel.wdql import Parallel, ParallelLearner


def step(learner, ending):
    before, after = (Observation(0, 0, 5, 0, x, 0, 0, 0) for x in (0.0, 1.0))
    learner.observe(Transition(before, Action.PLUS_X, after, 1, ending))


def practised():
    """One that has succeeded once, so that its agents walk."""
    grid = Grid((1, 1, 1), (1.0, 1.0, 1.0))
    learner = ParallelLearner(grid, Parallel(rounds=7), np.random.default_rng(1))
    step(learner, Kind.INSERTED)
    return learner


def broken(act, kind, **parameters):
    """A learner under one fault, one step later; where its agents were before that step."""
    learner = practised()
    act(learner, Running(Fault(kind, parameters), 0, 0, FOREVER, 1), 5)
    agents = learner.agents
    before = agents.places.copy(), agents.steps.copy()
    step(learner, None)
    return learner, before


def moved(learner, before):
    places, steps = before
    agents = learner.agents
    return not (np.array_equal(agents.places, places) and np.array_equal(agents.steps, steps))


def the_other_agents_go_on():
    learner, before = broken(lose_agent, "L3", agent=2.0)
    assert len(learner.agents.steps) == 5
    assert moved(learner, before)
    assert np.isfinite(learner.pool.q1 + learner.pool.q2).all()


def test_the_other_agents_go_on_when_one_is_gone():
    the_other_agents_go_on()


def test_a_learner_that_waits_for_all_of_its_agents_breaks_that_law(monkeypatch):
    sound = ParallelLearner.simulate

    def simulate(self, rounds):
        return len(self.agents.steps) == self.settings.agents and sound(self, rounds)

    monkeypatch.setattr(ParallelLearner, "simulate", simulate)
    with pytest.raises(AssertionError):
        the_other_agents_go_on()


def nothing_is_learnt_from_another_model():
    learner, before = broken(lose_server, "L4", what="wrong_model")
    assert learner.server.model is not learner.settings.model
    assert learner.refused == 1
    assert not moved(learner, before)


def test_a_server_that_judges_by_another_model_is_not_learnt_from():
    nothing_is_learnt_from_another_model()


def test_a_learner_that_does_not_ask_for_the_model_breaks_that_law(monkeypatch):
    def evaluate(self):
        classes = self.server.answer()
        self.classes = self.classes if classes is None else classes

    monkeypatch.setattr(ParallelLearner, "_evaluate", evaluate)
    with pytest.raises(AssertionError):
        nothing_is_learnt_from_another_model()


def test_a_restarted_server_is_noticed_and_the_agents_wait():
    learner, before = broken(lose_server, "L4", what="restart")
    assert learner.server.model is Model.LAST
    assert learner.restarts == 1
    assert not moved(learner, before)
