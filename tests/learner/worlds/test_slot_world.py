import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.action import Action
from controller.outcome import Kind
from learner.errors import UnknownWorldError
from learner.scripted import RandomPolicy
from learner.worlds.model import Model
from learner.worlds.named import model, models
from learner.worlds.slot import SlotWorld


def world_of(chosen, seed=1):
    world = SlotWorld(chosen)
    world.reset(np.random.default_rng(seed))
    return world


def episode(world, policy):
    seen, mets = world.begin(), []
    while True:
        mets.append(world.step(policy.choose(seen)))
        seen = mets[-1].observation
        if mets[-1].ending is not None:
            return mets


@pytest.mark.parametrize("name", list(models()))
@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=10, deadline=None)
def test_a_step_on_the_face_moves_one_pose_at_most_and_none_leaves_the_box(name, seed):
    world = world_of(model(name), seed)
    seen = world.begin()
    before, on_face = world.grid.cell(seen), seen.z == 0.0
    rng = np.random.default_rng(seed)
    for _ in range(50):
        action = Action(int(rng.integers(6)))
        met = world.step(action)
        after = world.grid.cell(met.observation)
        assert all(abs(place) <= half for place, half in zip(after, world.grid.halves, strict=True))
        if on_face:
            assert after in {before, world.grid.moved(before, action)}
        if met.ending is not None:
            return
        before, on_face = after, met.observation.z == 0.0


@pytest.mark.parametrize("name", list(models()))
@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=10, deadline=None)
def test_an_episode_ends_once_and_at_the_latest_at_k_max(name, seed):
    world = world_of(model(name), seed)
    mets = episode(world, RandomPolicy(np.random.default_rng(seed)))
    assert all(met.ending is None for met in mets[:-1])
    assert len(mets) <= world.max_steps
    assert (mets[-1].ending is Kind.LIMIT) <= (len(mets) == world.max_steps)
    with pytest.raises(ValueError, match="over"):
        world.step(Action.PLUS_X)


def test_the_same_seed_gives_the_same_episode():
    runs = [
        episode(world_of(model("R1"), 3), RandomPolicy(np.random.default_rng(4))) for _ in range(2)
    ]
    assert runs[0] == runs[1]


def test_the_part_goes_in_within_the_capture_and_not_beyond():
    world = world_of(Model((5, 5, 3), (4, 0, 0), capture=(2, 0, 0), mirrored=False))
    world.begin()
    endings = [world.step(Action.PLUS_X).ending for _ in range(2)]
    assert endings == [None, Kind.INSERTED]


def test_a_lagging_tip_meets_the_slot_later():
    world = world_of(Model((5, 5, 3), (2, 0, 0), lag=(1.0, 0.0), mirrored=False))
    world.begin()
    endings = [world.step(Action.PLUS_X).ending for _ in range(3)]
    assert endings == [None, None, Kind.INSERTED]


def test_a_random_walk_finds_the_papers_goal_as_rarely_as_is_exact():
    """7.6 % within 500 steps: the walk's transition matrix to the 500th power."""
    found = 0
    world = world_of(Model((8, 8, 6), (4, 4, 5)))
    rng = np.random.default_rng(1)
    for _ in range(150):
        found += episode(world, RandomPolicy(rng))[-1].ending is Kind.INSERTED
    assert 0.03 <= found / 150 <= 0.14


@given(st.integers(0, 2**32 - 1))
def test_a_new_grip_keeps_the_slot_in_the_box(seed):
    world = world_of(model("ffc"), seed)
    world.regrip()
    world.begin()
    assert all(abs(e) <= h for e, h in zip(world.error, world.grid.halves, strict=True))


def test_forces_show_the_way_to_a_slot_nearby():
    world = world_of(Model((5, 5, 3), (2, -2, 1), side=1.0, insertion=0.0, mirrored=False))
    seen = world.begin()
    assert (seen.fx, seen.fy, seen.tau_z) == (1.0, -1.0, 1.0)


def test_an_unknown_world_is_named_with_those_there_are():
    with pytest.raises(UnknownWorldError, match=r"no world 'k1'.*K1"):
        model("k1")


@pytest.mark.parametrize(
    "wrong", [{"hazard": 1.5}, {"capture": (-1, 0, 0)}, {"max_steps": 0}, {"slot": (9, 0, 0)}]
)
def test_numbers_that_make_no_world_are_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Model(**{"halves": (5, 5, 3), **wrong})
