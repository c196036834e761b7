"""The fast world of the cable task: the slot's mouth, its ends, and friction on the face."""

from dataclasses import replace
from math import hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.action import Action
from controller.outcome import Kind
from learner.worlds.model import Ends, Model
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


def test_a_caught_part_stays_whatever_the_jaws_do_across_the_slot():
    world, seen = caught((3.0, 0.0, 0.0))
    for action in (Action.PLUS_Y, Action.MINUS_THETA, Action.PLUS_THETA, Action.MINUS_Y):
        met = world.step(action)
        assert met.ending is None
        assert (met.observation.x, met.observation.z) == (seen.x, seen.z)


def test_the_jaws_turn_over_a_caught_part_and_come_back_along_y():
    world, seen = caught((3.0, 0.0, 0.0))
    across = world.step(Action.PLUS_Y).observation
    turned = world.step(Action.PLUS_THETA).observation
    assert across.y > seen.y
    assert turned.y == seen.y
    assert turned.theta > seen.theta


def test_the_way_along_the_slot_sinks_and_ends_in_it():
    world, seen = caught((3.0, 0.0, 0.0))
    first = world.step(Action.PLUS_X)
    assert first.observation.z < seen.z
    world.step(Action.PLUS_X)
    assert world.step(Action.PLUS_X).ending in {Kind.INSERTED, None}


def test_a_part_that_begins_over_the_slot_goes_in_before_the_first_step():
    world, seen = caught((0.2, 0.0, 0.0))
    met = world.step(Action.PLUS_X)
    assert met.ending is Kind.INSERTED
    assert met.observation.x == seen.x


HOLDING = replace(model("ffc"), ends=Ends(0.54, 1.5, held=1.0, strain=1.05))


def after(slot, *actions):
    """How the steps end for a part that begins on the face, the slot so far off, held for sure."""
    world = SlotWorld(HOLDING)
    world.reset(np.random.default_rng(1))
    world.place(slot=slot)
    world.begin()
    return [world.step(action).ending for action in actions]


AWAY, TOWARDS = Action.MINUS_X, Action.PLUS_X


def test_a_part_pushed_twice_against_the_end_of_the_slot_is_a_danger():
    assert after((0.5, 1.2, 0.0), AWAY, AWAY) == [None, Kind.DANGER]


@pytest.mark.parametrize("slot", [(0.5, 1.8, 0.0), (2.5, 1.2, 0.0), (0.5, 1.2, -2.0)])
def test_no_end_holds_a_corner_that_does_not_hang_over_the_mouth(slot):
    assert after(slot, AWAY, AWAY) == [None, None]


def test_the_corner_that_leads_is_the_one_that_is_held():
    assert after((0.5, 1.2, 2.0), AWAY, AWAY) == [None, Kind.DANGER]


def test_steps_to_and_fro_strain_nothing():
    assert after((0.5, 1.2, 0.0), AWAY, TOWARDS, AWAY, TOWARDS) == [None] * 4


@given(st.lists(st.sampled_from(Action), max_size=30))
def test_what_lags_along_one_axis_leaves_less_for_the_other(actions):
    far = Model((50, 50, 5), (45, 45, 0), lag=(0.7, 1.8), friction_circle=True, mirrored=False)
    world = SlotWorld(far)
    world.reset(np.random.default_rng(1))
    world.begin()
    for action in actions:
        world.step(action)
        behind = [e - j + s for e, j, s in zip(world.error, world.jaws, far.slot, strict=True)]
        assert hypot(behind[0] / 0.7, behind[1] / 1.8) <= 1.0 + 1e-9


def test_a_friction_circle_without_friction_is_refused():
    with pytest.raises(ValueError, match="friction_circle"):
        Model((5, 5, 3), friction_circle=True)


def test_a_chance_that_is_none_is_refused():
    with pytest.raises(ValueError, match="held"):
        Ends(0.5, 1.5, held=1.2, strain=1.0)
