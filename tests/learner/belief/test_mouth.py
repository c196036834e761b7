"""A part caught in the slot's mouth: what it tells, and that the learner gets out of it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.belief.learner import BeliefLearner
from learner.belief.mouth import Mouth, caught, slid, turned
from learner.belief.settings import Belief
from learner.grid import Cell, Grid
from learner.interface import Transition
from learner.worlds.evaluate import Protocol, evaluate
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld

GRID = Grid((5, 5, 3), (1.0, 1.0, 1.0))
SHAPE = GRID.shape
MOUTH = Mouth()
FACE, IN_MOUTH = -0.25e-3, -0.95e-3
cells = st.builds(Cell, st.integers(0, 10), st.integers(0, 10), st.integers(0, 6))


def seen(x, y, z, tau=0.0):
    return Observation(0, 0, 5, tau, x, y, z, 0)


def learner_that_fell_in(at_x=0, at_y=2):
    """It stepped along y on the face, and the last step took it into the mouth."""
    learner = BeliefLearner(GRID, Belief(), np.random.default_rng(1))
    learner.begin()
    before = seen(at_x, at_y - 1, FACE)
    learner.act(before)
    after = seen(at_x, at_y, IN_MOUTH)
    learner.observe(Transition(before, Action.PLUS_Y, after, 1, None))
    return learner, after


@given(at=cells, tau=st.floats(-0.1, 0.1), way=st.sampled_from((-1.0, 1.0)))
def test_no_evidence_from_the_mouth_rules_a_pose_out_by_itself(at, tau, way):
    assert (caught(SHAPE, at, MOUTH) > 0).all()
    assert (turned(SHAPE, at, tau, MOUTH) > 0).all()
    assert (slid(SHAPE, at, way, MOUTH) > 0).all()


def test_falling_in_tells_where_the_slot_is_across():
    learner, _ = learner_that_fell_in(at_y=2)
    share = learner.belief.sum(axis=(0, 2))
    assert share.argmax() == 2 + 5
    assert share.max() > 0.7


@pytest.mark.parametrize("x", range(-5, 6))
def test_in_the_mouth_only_steps_along_the_slot_are_taken(x):
    learner, at = learner_that_fell_in(at_x=x)
    assert learner.act(at).axis == 0


def test_at_full_depth_the_moment_says_which_way_to_turn():
    learner, _ = learner_that_fell_in()
    assert learner.act(seen(0, 2, -2.0e-3, tau=0.01)) is Action.PLUS_THETA
    assert learner.act(seen(0, 2, -2.0e-3, tau=-0.01)) is Action.MINUS_THETA


@pytest.mark.parametrize(("sank", "side"), [(True, 1), (False, -1)])
def test_sinking_on_a_step_along_x_says_that_the_slot_is_that_way(sank, side):
    learner, before = learner_that_fell_in()
    after = seen(1, 2, IN_MOUTH - 0.04e-3 if sank else IN_MOUTH + 0.04e-3)
    learner.observe(Transition(before, Action.PLUS_X, after, 2, None))
    share = learner.belief.sum(axis=(1, 2))
    beyond, behind = share[7:].sum(), share[:6].sum()
    assert (beyond - behind) * side > 0


def test_a_world_with_a_mouth_is_learnt_with_the_second_part_too():
    found = []
    for seed in range(8):
        world = SlotWorld(model("ffc"))
        learner = BeliefLearner(world.grid, Belief(), np.random.default_rng(seed))
        found += list(evaluate(learner, world, Protocol(6, 2), np.random.default_rng(seed)))
    assert not [one for one in found if one.kind is Kind.LIMIT]
    assert np.mean([one.steps for one in found if one.part == 2]) < 20
