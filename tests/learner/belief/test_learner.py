"""The belief learner on worlds: what it must never do again, and what it promises."""

import numpy as np
import pytest

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.belief.learner import BeliefLearner
from learner.belief.settings import Belief
from learner.belief.sides import Sides
from learner.checkpoint import Checkpoint, decode, encode
from learner.errors import CheckpointError
from learner.interface import Transition
from learner.worlds.evaluate import Protocol, evaluate
from learner.worlds.model import Model
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld

NOWHERE = Model((3, 3, 2), insertion=0.0, max_steps=1000)
"""A world whose slot takes nothing: the search has to go on for all of k_max."""


def learner_for(world, seed=1, settings=None):
    return BeliefLearner(world.grid, settings or Belief(), np.random.default_rng(seed))


def results(world, learner, protocol=None, seed=1):
    return list(evaluate(learner, world, protocol or Protocol(), np.random.default_rng(seed)))


def visited(world, learner):
    """Poses reached in one episode without an insertion."""
    world.reset(np.random.default_rng(1))
    learner.begin()
    seen, cells = world.begin(), set()
    for step in range(1, world.max_steps + 1):
        action = learner.act(seen)
        met = world.step(action)
        learner.observe(Transition(seen, action, met.observation, step, met.ending))
        seen = met.observation
        cells.add(world.grid.cell(seen))
    return cells


@pytest.mark.parametrize("base", [0.0, 1e-3, 0.05])
def test_the_search_never_freezes_where_nothing_is_found(base):
    world = SlotWorld(NOWHERE)
    found = visited(world, learner_for(world, settings=Belief(base_hazard=base)))
    assert len(found) == world.grid.states


def test_a_chance_danger_does_not_wall_the_slot_off():
    world = SlotWorld(Model((2, 0, 0), (2, 0, 0), mirrored=False))
    learner = learner_for(world)
    here = Observation(0, 0, 5, 0, 0.3e-3, 0, 0, 0)
    start = here._replace(x=0.0)
    learner.begin()
    learner.observe(Transition(start, Action.PLUS_X, here, 1, Kind.DANGER))
    assert [r.kind for r in results(world, learner, Protocol(3, 0))] == [Kind.INSERTED] * 3


def test_a_failed_insertion_does_not_delete_the_slot():
    world = SlotWorld(Model((4, 4, 3), (3, 3, 2), insertion=0.5))
    found = results(world, learner_for(world), Protocol(30, 0))
    assert all(result.kind is Kind.INSERTED for result in found[1:])


def test_slots_of_a_single_pose_are_found_again_after_a_new_grip():
    shares = []
    for seed in range(10):
        world = SlotWorld(Model((5, 5, 3), (3, 2, 2)))
        *_, first, second = results(world, learner_for(world, seed), Protocol(10, 2), seed)
        shares += [first.kind is Kind.INSERTED, second.kind is Kind.INSERTED]
    assert np.mean(shares) > 0.9


def test_a_known_slot_is_met_by_the_shortest_way_without_random_steps():
    world = SlotWorld(Model((5, 5, 3), (4, 2, 3)))
    late = results(world, learner_for(world))[30:48]
    assert {result.steps for result in late} == {9}


def test_an_announced_grip_change_saves_steps():
    class Deaf(BeliefLearner):
        def grip_changed(self):
            """Not told."""

    steps = {BeliefLearner: [], Deaf: []}
    for kind, found in steps.items():
        for seed in range(12):
            world = SlotWorld(model("K1"))
            learner = kind(world.grid, Belief(), np.random.default_rng(seed))
            found.append(results(world, learner, Protocol(8, 1), seed)[8].steps)
    assert np.mean(steps[BeliefLearner]) < 0.7 * np.mean(steps[Deaf])


def test_right_force_signs_shorten_the_first_search():
    told = Belief(sides=Sides((0.9, 0.9, 0.9)))
    steps = {}
    for name, settings in (("told", told), ("untold", Belief())):
        world = SlotWorld(Model((5, 5, 3), (4, 2, 3), side=0.9))
        steps[name] = [
            results(world, learner_for(world, seed, settings), Protocol(1, 0), seed)[0].steps
            for seed in range(12)
        ]
    assert np.mean(steps["told"]) < 0.8 * np.mean(steps["untold"])


def test_the_insertion_probability_is_estimated_from_what_happens():
    world = SlotWorld(Model((3, 3, 2), (1, 1, 1), insertion=0.5))
    sure = SlotWorld(Model((3, 3, 2), (1, 1, 1)))
    kernels = []
    for each in (world, sure):
        learner = learner_for(each)
        results(each, learner)
        kernels.append(learner.kernel[0])
    assert kernels[0] < 0.85 < kernels[1]


def test_the_same_seed_gives_the_same_steps():
    runs = [results(world := SlotWorld(model("K2")), learner_for(world)) for _ in range(2)]
    assert runs[0] == runs[1]


def test_a_learner_restored_in_the_middle_goes_on_as_if_there_had_been_no_break():
    world, other = (SlotWorld(model("K1")) for _ in range(2))
    whole, first = learner_for(world), learner_for(other)
    half = Protocol(6, 0)
    results(world, whole, half)
    results(other, first, half)
    restored = learner_for(other, seed=99)
    file = Checkpoint("belief", {}, "K1", 1, 6, {}, first.save())
    restored.load(decode(encode(file)).state)
    assert results(world, whole, half, seed=2) == results(other, restored, half, seed=2)


def test_a_state_of_another_box_is_refused():
    small = learner_for(SlotWorld(Model((1, 1, 1))))
    with pytest.raises(CheckpointError, match="visits"):
        small.load(learner_for(SlotWorld(Model((2, 2, 2)))).save())


@pytest.mark.parametrize(
    "wrong",
    [{"at_slot": 0.0}, {"gamma": 1.0}, {"floor": 0.0}, {"clearance": (-1, 0, 0)}, {"sweeps": 0}],
)
def test_settings_out_of_range_are_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Belief(**wrong)
