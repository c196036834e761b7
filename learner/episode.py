"""One learner in the search phase's place of a policy: what it sees becomes transitions."""

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.errors import LearnerError
from learner.interface import Learner, Transition

ENDINGS = frozenset((Kind.INSERTED, Kind.DANGER, Kind.LIMIT))
"""Endings that teach; a part not gripped or a fault of the cell says nothing about a pose."""


class Episode:
    """The policy of one episode; `end` tells the learner how it came out."""

    def __init__(self, learner: Learner) -> None:
        self._learner = learner
        self._last: tuple[Observation, Action] | None = None
        self.steps = 0
        learner.begin()

    def choose(self, observation: Observation) -> Action:
        """The learner's next step; LearnerError when it is none of the six."""
        self._learn(observation, None)
        action = self._learner.act(observation)
        if not isinstance(action, Action):
            raise LearnerError(f"{type(self._learner).__name__} chose {action!r}, not an Action")
        self._last = (observation, action)
        self.steps += 1
        return action

    def end(self, observation: Observation, ending: Kind) -> None:
        """The episode ended there and so; an ending that teaches nothing is not shown."""
        if ending in ENDINGS:
            self._learn(observation, ending)
        self._last = None

    def _learn(self, after: Observation, ending: Kind | None) -> None:
        """Nothing before the first step: a part that meets the slot at once teaches no step."""
        if self._last is not None:
            before, action = self._last
            self._learner.observe(Transition(before, action, after, self.steps, ending))
