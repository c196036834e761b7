"""Faults of a parallel learner: what is gone, and that the rest goes on."""

import numpy as np
import pytest

from controller.action import Action, Observation
from controller.outcome import Kind
from hil.app.agent_faults import lose_agent, lose_server
from hil.cell.faults.injector import FOREVER, Running
from hil.cell.faults.schedule import Fault
from learner.grid import Grid
from learner.interface import Transition
from learner.parallel.wdql import Parallel, ParallelLearner

GRID = Grid((1, 1, 1), (1.0, 1.0, 1.0))


def running(kind, **parameters):
    return Running(Fault(kind, parameters), 0, 0, FOREVER, 1)


def step(learner, ending=Kind.INSERTED):
    before, after = (Observation(0, 0, 5, 0, x, 0, 0, 0) for x in (0.0, 1.0))
    learner.observe(Transition(before, Action.PLUS_X, after, 1, ending))


@pytest.fixture
def learner():
    made = ParallelLearner(GRID, Parallel(rounds=7), np.random.default_rng(1))
    step(made)
    return made


def test_the_other_agents_go_on_when_one_is_gone(learner):
    one = running("L3", agent=2.0)
    lose_agent(learner, one, 5)
    lose_agent(learner, one, 6)
    assert one.effect == (5, "agent 2 of 6 is gone")
    walked = learner.agents.steps.copy()
    step(learner)
    assert len(learner.agents.steps) == len(learner.agents.places) == 5
    assert not np.array_equal(learner.agents.steps, walked)
    assert np.isfinite(learner.pool.q1).all()


def test_without_any_agent_the_robot_learns_alone(learner):
    for agent in range(6):
        lose_agent(learner, running("L3", agent=0.0), agent)
    tables = learner.pool.q1 + learner.pool.q2
    for _ in range(5):
        step(learner)
    assert not len(learner.agents.steps)
    assert not np.array_equal(learner.pool.q1 + learner.pool.q2, tables)


def test_an_agent_that_is_not_there_cannot_be_lost(learner):
    one = running("L3", agent=6.0)
    lose_agent(learner, one, 5)
    assert one.effect is None
    assert len(learner.agents.steps) == 6


@pytest.mark.parametrize("what", ["restart", "wrong_model"])
def test_what_the_server_became_is_in_the_log_and_the_learner_knows(learner, what):
    one = running("L4", what=what)
    lose_server(learner, one, 5)
    step(learner, None)
    assert one.effect[0] == 5
    assert (learner.restarts, learner.refused) == ((1, 0) if what == "restart" else (0, 1))
