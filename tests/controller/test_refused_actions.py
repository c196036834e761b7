"""Whatever a policy answers, the arm gets a step of Eq. 2 or none."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.action import Action, Pending
from controller.course import Course
from controller.cycle import Cycle
from controller.phases.search import PATIENCE, REFUSALS, accepted, take_step
from controller.place import Place
from controller.settings import Search

ZERO = (0.0,) * 6


def course():
    return Course(Cycle(0, None, None, ZERO, Place(0.0, 0.0, 0.0, 0.0)), 0.008)


class Answering:
    def __init__(self, *answers):
        self.answers = list(answers)

    def choose(self, observation):
        return self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]


def stepped(course, policy):
    """One step of the policy, hovering; whether the search goes on, and the set-points sent."""
    sent, phase = [], take_step(course, None, policy, Search())
    try:
        sent.append(next(phase))
        while True:
            sent.append(phase.send(course.cycle))
    except StopIteration as end:
        return end.value, sent


@pytest.mark.parametrize("wrong", [17, -1, float("nan"), "PLUS_X", 1.0, True, object(), [0]])
def test_an_action_that_is_none_is_refused_and_the_target_held(wrong):
    where = course()
    goes_on, sent = stepped(where, Answering(wrong))
    assert goes_on
    assert set(sent) == {Place(0.0, 0.0, 0.0, 0.0)}
    assert (where.steps, where.refused) == (0, 1)


def test_a_policy_that_gives_nothing_but_nonsense_is_given_up():
    where, policy = course(), Answering(float("nan"))
    results = [stepped(where, policy)[0] for _ in range(REFUSALS)]
    assert results == [True] * (REFUSALS - 1) + [False]


def test_one_good_action_makes_up_for_the_bad_ones():
    where, policy = course(), Answering(17, 17, Action.PLUS_X, 17, 17, 17, 17)
    assert all(stepped(where, policy)[0] for _ in range(7))


def test_none_gives_up_at_once():
    assert stepped(course(), Answering(None))[0] is False


@given(st.one_of(st.integers(), st.floats(), st.text(), st.none(), st.booleans()))
def test_what_is_accepted_is_an_action_of_eq_2(answer):
    found = accepted(course(), answer)
    assert found is None or found in list(Action)


@pytest.mark.parametrize("number", list(map(int, Action)))
def test_a_plain_number_of_an_action_is_one(number):
    assert accepted(course(), number) is Action(number)


@given(st.integers(0, 200))
def test_the_target_is_held_while_the_policy_thinks_and_its_answer_is_then_taken(periods):
    where = course()
    thinking = [Pending.PENDING] * periods
    goes_on, sent = stepped(where, Answering(*thinking, Action.PLUS_X))
    assert goes_on
    assert sent[:periods] == [Place(0.0, 0.0, 0.0, 0.0)] * periods
    assert (where.held, where.steps) == (periods, 1)


def test_a_policy_that_never_answers_is_given_up():
    where = course()
    goes_on, sent = stepped(where, Answering(Pending.PENDING))
    assert not goes_on
    assert len(sent) == where.held == round(PATIENCE / where.period)
    assert set(sent) == {Place(0.0, 0.0, 0.0, 0.0)}
