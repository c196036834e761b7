import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.action import Action
from learner.belief.hazard import Hazard
from learner.belief.planning import Plan
from learner.grid import Cell
from learner.tabular.dice import words

SHAPE = (5, 4, 3)
CELLS = st.builds(Cell, *(st.integers(0, size - 1) for size in SHAPE))
DICE = words(np.random.default_rng(1), 1)


def sure_of(cell):
    success = np.zeros(SHAPE)
    success[cell] = 1.0
    return success


def stepped(cell, action):
    place = list(cell)
    place[action.axis] += action.sign
    return Cell(*place)


@given(CELLS, CELLS)
def test_worth_of_a_pose_falls_by_gamma_with_each_step_from_a_sure_slot(slot, cell):
    plan = Plan(SHAPE)
    plan.improve(sure_of(slot), np.zeros(SHAPE), gamma=0.9, danger=3.0, sweeps=40)
    distance = sum(abs(a - b) for a, b in zip(slot, cell, strict=True))
    assert plan.worth[1:-1, 1:-1, 1:-1][cell] == pytest.approx(0.9**distance)


@given(CELLS, CELLS)
def test_the_way_to_a_sure_slot_is_a_shortest_one(slot, cell):
    plan = Plan(SHAPE)
    plan.improve(sure_of(slot), np.zeros(SHAPE), gamma=0.9, danger=3.0, sweeps=40)
    distance = sum(abs(a - b) for a, b in zip(slot, cell, strict=True))
    for _ in range(distance):
        cell = stepped(cell, Action(plan.step(cell, DICE)))
    assert cell == slot


@given(st.integers(0, 2**32 - 1))
def test_more_sweeps_do_not_change_a_plan_that_has_settled(seed):
    rng = np.random.default_rng(seed)
    success, hazard = rng.random(SHAPE), 0.1 * rng.random(SHAPE)
    plan = Plan(SHAPE)
    plan.improve(success, hazard, gamma=0.9, danger=3.0, sweeps=300)
    settled = plan.worth.copy()
    plan.improve(success, hazard, gamma=0.9, danger=3.0, sweeps=1)
    assert plan.worth == pytest.approx(settled, abs=1e-12)


@given(CELLS)
@settings(max_examples=20)
def test_no_step_leads_out_of_the_box(cell):
    plan = Plan(SHAPE)
    plan.improve(np.full(SHAPE, 0.01), np.zeros(SHAPE), gamma=0.9, danger=3.0, sweeps=5)
    for _ in range(30):
        after = stepped(cell, Action(plan.step(cell, DICE)))
        assert all(0 <= place < size for place, size in zip(after, SHAPE, strict=True))


def test_steps_that_are_equally_good_are_drawn_among():
    plan = Plan((3, 3, 3))
    assert {plan.step(Cell(1, 1, 1), DICE) for _ in range(200)} == set(range(6))


def test_a_dangerous_pose_is_gone_around():
    success, hazard = np.zeros((3, 3, 1)), np.zeros((3, 3, 1))
    success[2, 0, 0], hazard[1, 0, 0] = 1.0, 0.5
    plan = Plan((3, 3, 1))
    plan.improve(success, hazard, gamma=0.9, danger=3.0, sweeps=20)
    assert Action(plan.step(Cell(0, 0, 0), DICE)) is Action.PLUS_Y


@given(st.integers(0, 2**32 - 1), st.floats(0.0, 5.0), st.floats(0.0, 0.1))
def test_where_every_pose_is_as_dangerous_as_any_the_cost_of_a_danger_changes_no_plan(
    seed, danger, base
):
    success = np.random.default_rng(seed).random(SHAPE)
    plain, costly = Plan(SHAPE), Plan(SHAPE)
    unseen = Hazard(SHAPE, base).excess
    plain.improve(success, np.zeros(SHAPE), gamma=0.9, danger=0.0, sweeps=12)
    costly.improve(success, unseen, gamma=0.9, danger=danger, sweeps=12)
    assert costly.worth == pytest.approx(plain.worth, abs=1e-12)
