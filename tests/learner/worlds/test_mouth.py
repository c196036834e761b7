"""The fast world of the cable task: a part caught in the slot's mouth."""

import numpy as np

from controller.action import Action
from controller.outcome import Kind
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld


def caught(slot):
    world = SlotWorld(model("ffc"))
    world.reset(np.random.default_rng(1))
    world.place(slot=slot)
    return world, world.begin()


def test_a_part_beside_the_middle_of_the_slot_is_caught_and_shows_it():
    _, seen = caught((3.0, 0.0, 0.0))
    assert seen.z < -0.2e-3


def test_a_caught_part_stays_whatever_it_does_across_the_slot():
    world, seen = caught((3.0, 0.0, 0.0))
    for action in (Action.PLUS_Y, Action.MINUS_THETA, Action.PLUS_THETA, Action.MINUS_Y):
        met = world.step(action)
        assert met.ending is None
        assert (met.observation.x, met.observation.y, met.observation.z) == (seen.x, seen.y, seen.z)


def test_the_way_along_the_slot_sinks_and_ends_in_it():
    world, seen = caught((3.0, 0.0, 0.0))
    first = world.step(Action.PLUS_X)
    assert first.observation.z < seen.z
    world.step(Action.PLUS_X)
    assert world.step(Action.PLUS_X).ending in {Kind.INSERTED, None}
