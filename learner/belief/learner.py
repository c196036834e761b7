"""The belief learner: filter, hazard map and plan behind the calls of a learner.

Of the paper's scheme it keeps that the real robot informs a server which plans for it. The server
is the belief, the simulated agents are value iteration; there is no random step.
"""

import numpy as np

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.belief import filter as bayes
from learner.belief.hazard import Hazard
from learner.belief.mouth import Sinking, Slide, caught, slid, turned
from learner.belief.planning import Plan
from learner.belief.settings import Belief
from learner.belief.sides import likelihood
from learner.grid import Cell, Grid
from learner.interface import State, Transition
from learner.parallel.wdql import part
from learner.tabular.dice import words
from learner.tabular.tables import restore

_WEIGHT = 10.0
"""Insertions and misses at the slot that the first guess of `at_slot` is worth."""
_FIRST_SWEEPS = 40
"""From nothing: a worth travels one step a sweep at worst, across the box in this many."""


class BeliefLearner:
    """Where the slot may be, what was dangerous, and how sure an insertion is at the slot."""

    def __init__(self, grid: Grid, settings: Belief, rng: np.random.Generator) -> None:
        self.grid, self.settings = grid, settings
        self.belief = bayes.unknown(grid.shape)
        self.hazard = Hazard(grid.shape, settings.base_hazard)
        self.plan = Plan(grid.shape)
        # Insertions and misses at the slot, whose ratio is the estimate of at_slot; (2,).
        self.tries = _WEIGHT * np.array([settings.at_slot, 1.0 - settings.at_slot])
        self.dice = words(rng, 1)
        self.sinking = Sinking()
        self._slide = Slide(grid.shape[0], settings.mouth)

    def begin(self) -> None:
        """A little may have changed since the last episode; plan from nothing."""
        self.belief = bayes.drifted(self.belief, self.settings.drift, self.settings.floor)
        self.plan.forget()
        self._replan(_FIRST_SWEEPS)

    def act(self, observation: Observation) -> Action:
        """By the plan; in the slot's mouth by what leads on there."""
        self.sinking.look(observation)
        depth, at = self.sinking.depth(observation), self._at(observation)
        if depth > self.settings.mouth.home:
            return Action.PLUS_THETA if observation.tau_z > 0 else Action.MINUS_THETA
        if depth > self.settings.mouth.depth:
            return self._slide.step(self.belief, at, self.settings.gamma, self.dice)
        return Action(self.plan.step(at, self.dice))

    def observe(self, transition: Transition) -> None:
        """Update and plan anew; an episode's end is planned for when the next one begins."""
        at, ending = self._at(transition.after), transition.ending
        self.hazard.note(at, ending)
        # A danger ended the step before the part could settle: it tells nothing of the slot.
        if ending is not Kind.DANGER:
            self._learn(transition, went_in=ending is Kind.INSERTED)
        if ending is None:
            self._replan(self.settings.sweeps)

    def grip_changed(self) -> None:
        """The slot, as the robot sees it, moved with the part in the jaws."""
        self.belief = bayes.widened(
            self.belief, self.settings.clearance, self.settings.new_grip_floor
        )

    @property
    def kernel(self) -> bayes.Array:
        """Chance an axis that the part goes in, by steps off the slot."""
        return np.array([self.tries[0] / self.tries.sum(), self.settings.beside_slot])

    def values(self) -> bayes.Array:
        """What the plan holds it worth to step onto each pose, (x, y, theta)."""
        return self.plan.worth[1:-1, 1:-1, 1:-1].copy()

    def _learn(self, transition: Transition, *, went_in: bool) -> None:
        after = transition.after
        at, shape = self._at(after), self.grid.shape
        chance = bayes.going_in(shape, at, self.kernel)
        if went_in:
            self.belief = bayes.inserted(self.belief, chance)
            self.tries[0] += 1.0
            return
        if self._in_mouth(after):
            self._caught(transition, at)
            return
        self.belief = bayes.missed(self.belief, chance)
        if self.settings.sides is not None:
            signs = likelihood(shape, at, after, self.settings.sides)
            self.belief = bayes.told(self.belief, signs)
        # As in expectation maximisation: a miss counts by how likely the slot was here.
        self.tries[1] += self.belief[at]

    def _caught(self, transition: Transition, at: Cell) -> None:
        """Entering the mouth tells y at once; inside, only a step along x tells anything new."""
        before, action, after = transition.before, transition.action, transition.after
        shape, mouth = self.grid.shape, self.settings.mouth
        if not self._in_mouth(before):
            signs = caught(shape, at, mouth) * turned(shape, at, after.tau_z, mouth)
            self.belief = bayes.told(self.belief, signs)
        elif action.axis == 0:
            way = action.sign * (1 if after.z < before.z else -1)
            self.belief = bayes.told(self.belief, slid(shape, at, way, mouth))

    def _in_mouth(self, observation: Observation) -> bool:
        return self.sinking.depth(observation) > self.settings.mouth.depth

    def _replan(self, sweeps: int) -> None:
        success = bayes.success(self.belief, self.kernel)
        settings = self.settings
        self.plan.improve(success, self.hazard.excess, settings.gamma, settings.danger, sweeps)

    def _at(self, observation: Observation) -> Cell:
        """The pose, counted from the box's corner."""
        cell = self.grid.cell(observation)
        x, y, theta = self.grid.halves
        return Cell(cell.x + x, cell.y + y, cell.theta + theta)

    def save(self) -> State:
        return {
            "belief": self.belief.copy(),
            "hazard": self.hazard.save(),
            "worth": self.plan.worth.copy(),
            "tries": self.tries.copy(),
            "face": self.sinking.face.copy(),
            "dice": self.dice.copy(),
        }

    def load(self, state: State) -> None:
        """Take up a saved learner; CheckpointError for one of another kind or box."""
        self.hazard.load(part(state, "hazard"))
        restore("belief", self.belief, state.get("belief"))
        restore("worth", self.plan.worth, state.get("worth"))
        restore("tries", self.tries, state.get("tries"))
        restore("face", self.sinking.face, state.get("face"))
        restore("dice", self.dice, state.get("dice"))
