import pytest

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.episode import Episode
from learner.errors import LearnerError
from learner.interface import Transition


class Notebook:
    """A learner that always goes the same way and writes down what it is told."""

    def __init__(self, action=Action.PLUS_X):
        self.action = action
        self.begun = 0
        self.told = []

    def begin(self):
        self.begun += 1

    def act(self, observation):
        return self.action

    def observe(self, transition):
        self.told.append(transition)


def at(x):
    return Observation(0, 0, 5, 0, x, 0, 0, 0)


def test_each_step_is_told_once_with_what_came_before_and_after():
    learner = Notebook()
    episode = Episode(learner)
    for x in (0.0, 1.0, 2.0):
        episode.choose(at(x))
    episode.end(at(3.0), Kind.INSERTED)
    assert learner.begun == 1
    assert learner.told == [
        Transition(at(0.0), Action.PLUS_X, at(1.0), 1, None),
        Transition(at(1.0), Action.PLUS_X, at(2.0), 2, None),
        Transition(at(2.0), Action.PLUS_X, at(3.0), 3, Kind.INSERTED),
    ]


def test_a_part_that_goes_in_without_a_step_teaches_nothing():
    learner = Notebook()
    Episode(learner).end(at(0.0), Kind.INSERTED)
    assert learner.told == []


@pytest.mark.parametrize("ending", [Kind.FAULT, Kind.NO_GRIP])
def test_an_ending_that_is_no_fault_of_the_pose_is_not_told(ending):
    learner = Notebook()
    episode = Episode(learner)
    episode.choose(at(0.0))
    episode.end(at(1.0), ending)
    assert learner.told == []


@pytest.mark.parametrize("wrong", [6, None, "+x", float("nan")])
def test_an_action_that_is_none_of_the_six_is_refused(wrong):
    with pytest.raises(LearnerError, match="not an Action"):
        Episode(Notebook(wrong)).choose(at(0.0))
