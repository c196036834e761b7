from dataclasses import replace

import numpy as np
import pytest

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.errors import CheckpointError
from learner.grid import Cell, Grid
from learner.interface import Transition
from learner.parallel.agents import Agents
from learner.parallel.outcomes import DANGER, SUCCESS, Outcomes
from learner.parallel.server import Model, evaluate
from learner.parallel.wdql import Parallel, ParallelLearner
from learner.tabular.alone import rows
from learner.tabular.settings import Tabular

GRID = Grid((3, 3, 2), (0.3e-3, 0.3e-3, 0.0175))
GOAL = Cell(2, -1, 1)


def seen(cell):
    x, y, theta = (step * size for step, size in zip(cell, GRID.sizes, strict=True))
    return Observation(0, 0, 5, 0, x, y, 0, theta)


def episode(learner, limit=500):
    """One episode on the grid with a single good cell; steps taken."""
    learner.begin()
    cell = Cell(0, 0, 0)
    for step in range(1, limit + 1):
        action = learner.act(seen(cell))
        after = GRID.moved(cell, action)
        ending = Kind.INSERTED if after == GOAL else Kind.LIMIT if step == limit else None
        learner.observe(Transition(seen(cell), action, seen(after), step, ending))
        cell = after
        if ending is not None:
            return step
    return limit


def make(seed=1, **settings):
    return ParallelLearner(GRID, Parallel(**settings), np.random.default_rng(seed))


def test_the_agents_wait_for_the_first_real_success():
    learner = make()
    action = Action.PLUS_X
    learner.observe(Transition(seen(Cell(0, 0, 0)), action, seen(Cell(1, 0, 0)), 1, None))
    assert not learner.agents.steps.any()
    assert not learner.pool.q1.any()
    learner.observe(Transition(seen(Cell(1, 0, 0)), action, seen(GOAL), 2, Kind.INSERTED))
    assert learner.agents.steps.any()


def test_after_the_first_success_the_way_is_soon_short():
    learner = make()
    lengths = [episode(learner) for _ in range(12)]
    assert np.median(lengths[4:]) <= 10
    assert lengths[-1] < 30


def test_without_agents_one_success_teaches_one_step_only():
    learner = make(agents=0)
    episode(learner)
    assert np.count_nonzero(learner.pool.q1 + learner.pool.q2) == 1


def test_the_same_seed_gives_the_same_tables_to_the_bit():
    a, b, c = make(seed=5), make(seed=5), make(seed=6)
    for learner in (a, b, c):
        for _ in range(5):
            episode(learner)
    assert np.array_equal(a.pool.q1, b.pool.q1)
    assert np.array_equal(a.agents.places, b.agents.places)
    assert not np.array_equal(a.pool.q1, c.pool.q1)


def test_pacing_the_agents_differently_changes_nothing():
    a, b = make(seed=5), make(seed=5)
    for learner in (a, b):
        learner.classes[GRID.row(GOAL)] = SUCCESS
    tabular = Tabular()
    a.agents.run(a.pool, GRID, a.classes, tabular, 1000)
    for rounds in (1, 399, 600):
        b.agents.run(b.pool, GRID, b.classes, tabular, rounds)
    assert np.array_equal(a.pool.q1, b.pool.q1)
    assert np.array_equal(a.pool.q2, b.pool.q2)


def test_a_restored_learner_goes_on_as_if_there_had_been_no_break():
    whole, broken = make(seed=2), make(seed=2)
    for _ in range(3):
        episode(whole)
        episode(broken)
    revived = make(seed=99)
    revived.load(broken.save())
    assert [episode(whole) for _ in range(3)] == [episode(revived) for _ in range(3)]
    assert np.array_equal(whole.pool.q2, revived.pool.q2)


def test_a_learner_that_lost_an_agent_goes_on_without_it_after_a_break():
    whole, broken = make(seed=2), make(seed=2)
    for learner in (whole, broken):
        episode(learner)
        agents = learner.agents
        learner.agents = Agents(agents.places[1:].copy(), agents.steps[1:].copy(), agents.start)
        episode(learner)
    revived = make(seed=99)
    revived.load(broken.save())
    assert len(revived.agents.steps) == 5
    assert [episode(whole) for _ in range(3)] == [episode(revived) for _ in range(3)]
    assert np.array_equal(whole.pool.q2, revived.pool.q2)


def test_a_learner_with_more_agents_than_this_one_has_is_refused():
    with pytest.raises(CheckpointError):
        make(agents=5).load(make(agents=6).save())


def test_a_server_that_judged_by_another_model_is_still_not_learnt_from_after_a_break():
    learner = practised(model=Model.QUADRATIC)
    learner.server.model = Model.LINEAR
    learner.take_in(rows(GRID, Transition(seen(GOAL), Action.PLUS_X, seen(GOAL), 2, Kind.LIMIT)))
    revived = make(model=Model.QUADRATIC)
    revived.load(learner.save())
    assert not learner.simulate(1)
    assert not revived.simulate(1)


def test_a_server_that_restarted_before_a_break_is_noticed_after_it():
    learner = practised()
    learner.server.restart()
    revived = make()
    revived.load(learner.save())
    step(revived)
    assert revived.restarts == 1


def test_a_learner_of_another_box_is_refused():
    other = ParallelLearner(replace_halves(GRID, (4, 3, 2)), Parallel(), np.random.default_rng(0))
    with pytest.raises(CheckpointError, match="q1"):
        other.load(make().save())


def replace_halves(grid, halves):
    return grid._replace(halves=halves)


def test_a_saved_state_is_not_moved_by_later_learning():
    learner = make(seed=3)
    episode(learner)
    state = learner.save()
    before = state["pool"]["q1"].copy()
    episode(learner)
    assert np.array_equal(state["pool"]["q1"], before)


def practised(**settings):
    learner = make(**settings)
    episode(learner)
    return learner


def step(learner):
    """One real step that ends nothing."""
    before, after = Cell(0, 0, 0), Cell(1, 0, 0)
    learner.observe(Transition(seen(before), Action.PLUS_X, seen(after), 1, None))


def test_agents_do_not_learn_from_a_server_that_judges_by_another_model():
    learner = practised()
    learner.server.model = Model.QUADRATIC
    walked, refused = learner.agents.steps.copy(), learner.refused
    step(learner)
    step(learner)
    assert np.array_equal(learner.agents.steps, walked)
    assert learner.refused == refused + 2
    learner.server.model = learner.settings.model
    step(learner)
    assert not np.array_equal(learner.agents.steps, walked)


def test_a_server_that_has_forgotten_is_noticed_and_the_agents_wait_for_a_success_again():
    learner = practised()
    learner.server.restart()
    walked = learner.agents.steps.copy()
    step(learner)
    step(learner)
    assert learner.restarts == 1
    assert np.array_equal(learner.agents.steps, walked)
    assert not learner.classes.any(), "what the old server said is not the new one's word"
    learner.observe(Transition(seen(Cell(1, 0, 0)), Action.PLUS_X, seen(GOAL), 2, Kind.INSERTED))
    assert not np.array_equal(learner.agents.steps, walked)


def test_a_classifier_that_has_met_successes_only_says_nothing_yet():
    learner = make(model=Model.LINEAR)
    learner.observe(Transition(seen(Cell(0, 0, 0)), Action.PLUS_X, seen(GOAL), 1, Kind.INSERTED))
    assert not learner.classes.any()


def outcomes_of_one_good_pose():
    outcomes = Outcomes(GRID.states)
    for row in range(GRID.states):
        cell = GRID.at(row)
        outcomes.note(row, Kind.INSERTED if cell == Cell(0, 0, 0) else None)
    return outcomes


def test_a_linear_classifier_cannot_say_that_one_pose_in_the_middle_is_good():
    classes = evaluate(Model.LINEAR, GRID, outcomes_of_one_good_pose())
    assert SUCCESS not in classes


def test_the_last_label_says_exactly_what_was_met():
    outcomes = outcomes_of_one_good_pose()
    outcomes.note(3, Kind.DANGER)
    classes = evaluate(Model.LAST, GRID, outcomes)
    assert [i for i, label in enumerate(classes) if label == SUCCESS] == [GRID.row(Cell(0, 0, 0))]
    assert [i for i, label in enumerate(classes) if label == DANGER] == [3]


def test_a_quadratic_classifier_finds_a_good_region():
    outcomes = Outcomes(GRID.states)
    for row in range(GRID.states):
        near = sum(step * step for step in GRID.at(row)) <= 2
        outcomes.note(row, Kind.INSERTED if near else None)
    classes = evaluate(Model.QUADRATIC, GRID, outcomes)
    assert classes[GRID.row(Cell(0, 0, 0))] == SUCCESS
    assert classes[GRID.row(Cell(3, 3, 2))] != SUCCESS


@pytest.mark.parametrize(
    "wrong", [{"psi": 0.0}, {"gamma": 1.0}, {"greedy": 1.5}, {"c": 0.0}, {"max_steps": 0}]
)
def test_settings_that_make_no_learner_are_refused(wrong):
    with pytest.raises(ValueError, match="found"):
        replace(Tabular(), **wrong)
