import pytest

from controller.action import Action
from controller.course import Course
from controller.cycle import Cycle
from controller.phases.search import step_of
from controller.place import Place
from controller.settings import Search

SEARCH = Search()


def at(place):
    zero = (0.0,) * 6
    return Course(Cycle(0, None, None, zero, place), 0.008)


@pytest.mark.parametrize("action", list(Action))
def test_each_action_moves_one_axis_by_its_step(action):
    step = step_of(at(Place(0.0, 0.0, 0.0, 0.0)), action, SEARCH)
    size = (SEARCH.step, SEARCH.step, SEARCH.step_rotation)[action.axis]
    assert step[action.axis] == action.sign * size
    assert sum(map(abs, step)) == size


def test_opposite_actions_cancel():
    for positive in (Action.PLUS_X, Action.PLUS_Y, Action.PLUS_THETA):
        negative = Action(positive + 1)
        assert (negative.axis, negative.sign) == (positive.axis, -positive.sign)


def test_a_step_out_of_the_box_is_not_taken_but_one_back_into_it_is():
    edge = at(Place(10 * SEARCH.step, 0.0, 0.0, 0.0))
    assert step_of(edge, Action.PLUS_X, SEARCH) == (0.0, 0.0, 0.0)
    assert step_of(edge, Action.MINUS_X, SEARCH)[0] == -SEARCH.step
    far = at(Place(20 * SEARCH.step, 0.0, 0.0, 0.0))
    assert step_of(far, Action.MINUS_X, SEARCH)[0] == -SEARCH.step
