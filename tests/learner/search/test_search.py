import numpy as np
import pytest

from controller.outcome import Kind
from learner.errors import CheckpointError
from learner.interface import Transition
from learner.search.learner import SearchLearner
from learner.search.settings import Search
from learner.worlds.evaluate import Protocol, evaluate
from learner.worlds.model import Model
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld


def learner_for(world, seed=1):
    return SearchLearner(world.grid, Search(), np.random.default_rng(seed))


def results(world, learner, protocol=None, seed=1):
    return list(evaluate(learner, world, protocol or Protocol(), np.random.default_rng(seed)))


def test_every_pose_of_the_box_is_tried_before_any_is_given_up():
    world = SlotWorld(Model((3, 3, 2), insertion=0.0, max_steps=400))
    learner = learner_for(world)
    world.reset(np.random.default_rng(1))
    learner.begin()
    seen, cells = world.begin(), set()
    for step in range(1, 401):
        action = learner.act(seen)
        met = world.step(action)
        learner.observe(Transition(seen, action, met.observation, step, met.ending))
        seen = met.observation
        cells.add(world.grid.cell(seen))
    assert len(cells) == world.grid.states


def test_the_remembered_slot_is_gone_to_by_the_shortest_way():
    world = SlotWorld(Model((4, 4, 2), (3, 2, 1)))
    found = results(world, learner_for(world), Protocol(5, 0))
    assert [result.steps for result in found[1:]] == [6] * 4


def test_after_a_new_grip_the_slot_is_found_around_its_last_place():
    world = SlotWorld(Model((5, 5, 3), (3, 2, 2)))
    for seed in range(5):
        *_, first, second = results(world, learner_for(world), seed=seed)
        assert (first.kind, second.kind) == (Kind.INSERTED, Kind.INSERTED)
        assert second.steps <= first.steps


def test_the_same_seed_gives_the_same_steps():
    runs = [results(world := SlotWorld(model("R1")), learner_for(world)) for _ in range(2)]
    assert runs[0] == runs[1]


def test_a_learner_restored_in_the_middle_goes_on_as_if_there_had_been_no_break():
    world, other = (SlotWorld(model("R1")) for _ in range(2))
    whole, first = learner_for(world), learner_for(other)
    half = Protocol(6, 0)
    results(world, whole, half)
    results(other, first, half)
    restored = learner_for(other, seed=99)
    restored.load(first.save())
    assert results(world, whole, half, seed=2) == results(other, restored, half, seed=2)


def test_a_state_of_another_box_is_refused():
    small = learner_for(SlotWorld(Model((1, 1, 1))))
    with pytest.raises(CheckpointError, match="tried"):
        small.load(learner_for(SlotWorld(Model((2, 2, 2)))).save())
