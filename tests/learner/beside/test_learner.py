import numpy as np
import pytest

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.beside.learner import BesideLearner
from learner.errors import LearnerGoneError
from learner.grid import Cell, Grid
from learner.interface import Transition
from learner.parallel.wdql import Parallel, ParallelLearner
from learner.tabular.settings import Tabular

GRID = Grid((2, 2, 1), (1.0, 1.0, 1.0))
SETTINGS = Parallel(Tabular(greedy=1.0))


def seen(cell):
    return Observation(0, 0, 5, 0, *cell[:2], 0, cell[2])


def success():
    return Transition(seen(Cell(1, 0, 0)), Action.PLUS_X, seen(Cell(2, 0, 0)), 5, Kind.INSERTED)


@pytest.fixture
def learner():
    with BesideLearner(GRID, SETTINGS, np.random.default_rng(1)) as beside:
        yield beside


def until(condition):
    while not condition():
        pass


def test_what_the_robot_met_becomes_a_policy_for_poses_it_never_saw(learner):
    until(lambda: learner.version > 0)
    learner.observe(success())
    before = learner.version
    until(lambda: learner.version > before + 4)
    state = learner.save()
    revived = ParallelLearner(GRID, SETTINGS, np.random.default_rng(0))
    revived.load(state)
    assert revived.outcomes.successes == 1
    cell, steps = Cell(0, 0, 0), 0
    while cell != Cell(2, 0, 0) and steps < 10:
        cell, steps = GRID.moved(cell, revived.act(seen(cell))), steps + 1
    assert cell == Cell(2, 0, 0)


def test_a_saved_state_is_where_the_next_process_begins(learner):
    learner.observe(success())
    until(lambda: learner.version > 4)
    state = learner.save()
    with BesideLearner(GRID, SETTINGS, np.random.default_rng(2), state) as again:
        until(lambda: again.version > 0)
        assert again.act(seen(Cell(1, 0, 0))) is Action.PLUS_X


def test_a_dead_learner_ends_the_next_episode_before_it_begins(learner):
    until(lambda: learner.version > 0)
    learner.begin()
    learner._process.kill()
    learner._process.join()
    with pytest.raises(LearnerGoneError, match="-9"):
        learner.begin()
    with pytest.raises(LearnerGoneError):
        learner.save()
