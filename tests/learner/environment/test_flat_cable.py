import subprocess
import sys

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="needs the extra 'gym'")

from gymnasium.utils.env_checker import check_env  # noqa: E402
from hypothesis import given, settings  # noqa: E402
from hypothesis import strategies as st  # noqa: E402

from controller.action import Action  # noqa: E402
from controller.outcome import Kind  # noqa: E402
from learner.environment.flat_cable import FlatCable  # noqa: E402
from learner.environment.registration import NAME, register  # noqa: E402
from learner.errors import UnknownWorldError  # noqa: E402
from learner.task import reward  # noqa: E402
from learner.worlds.model import Model  # noqa: E402
from learner.worlds.slot import SlotWorld  # noqa: E402


def walk(env, seed, actions):
    seen = [env.reset(seed=seed)]
    for action in actions:
        seen.append(env.step(action))
        if seen[-1][2] or seen[-1][3]:
            seen.append(env.reset())
    return seen


def same(a, b):
    return all(repr(x) == repr(y) for x, y in zip(a, b, strict=True))


@pytest.mark.parametrize("forces", [False, True])
@pytest.mark.parametrize("world", ["G0", "K1", "ffc"])
def test_gymnasiums_own_checker_finds_nothing(world, forces):
    env = gymnasium.make(register(), world=world, forces=forces, render_mode="rgb_array").unwrapped
    check_env(env)


@given(st.integers(0, 2**32 - 1), st.lists(st.integers(0, 5), max_size=60))
@settings(max_examples=20, deadline=None)
def test_the_same_seed_and_actions_give_the_same_episodes(seed, actions):
    assert same(*(walk(FlatCable("ffc", forces=True), seed, actions) for _ in range(2)))


def test_another_seed_is_another_cell():
    env = FlatCable("ffc")
    slots = set()
    for seed in range(5):
        env.reset(seed=seed)
        slots.add(env.world.slot)
    assert len(slots) == 5


def test_a_plain_reset_keeps_the_cell_and_a_new_grip_is_asked_for():
    env = FlatCable("ffc")
    env.reset(seed=1)
    slot, before = env.world.slot, env.world.error
    env.reset()
    assert (env.world.slot, env.world.error) == (slot, before)
    env.reset(options={"regrip": True})
    assert env.world.slot == slot
    assert env.world.error != before


@given(st.integers(0, 1000), st.sampled_from(["K1", "K2", "R1", "ffc"]))
@settings(max_examples=30, deadline=None)
def test_an_episode_pays_eq_4_once_at_its_end(seed, world):
    env = FlatCable(world)
    env.reset(seed=seed)
    env.action_space.seed(seed)
    k = 0
    while True:
        k += 1
        seen, paid, over, cut, told = env.step(env.action_space.sample())
        assert env.observation_space.contains(seen)
        if over or cut:
            break
        assert (paid, told["ending"]) == (0.0, "")
    assert over != cut
    assert cut == (told["ending"] == "limit")
    assert paid == reward(Kind(told["ending"]), k, env.world.max_steps)


def test_forces_are_shown_over_their_bounds_and_cut():
    env = FlatCable(SlotWorld(Model((3, 3, 2))), forces=True)
    seen, _ = env.reset(seed=1)
    assert seen.tolist() == [0, 0, 0, 0, 0, 0.5, 0]


def test_many_cells_run_side_by_side_each_with_its_own_seed():
    envs = gymnasium.make_vec(register(), num_envs=3, vectorization_mode="sync", world="K1")
    seen, told = envs.reset(seed=[1, 2, 3])
    assert (seen.shape, told["cell"].shape) == ((3, 3), (3, 3))
    seen, paid, *_ = envs.step(np.array([0, 2, 4]))
    assert np.array_equal(np.sign(seen), np.eye(3))
    assert paid.tolist() == [0.0] * 3
    envs.close()


def test_the_picture_shows_the_box_the_jaws_and_how_it_ended():
    env = FlatCable(SlotWorld(Model((2, 2, 1), (2, 0, 0), mirrored=False)), render_mode="rgb_array")
    env.reset(seed=1)
    running = env.render()
    assert running.shape == (5 * 24 + 12, 6 * 24 + 18, 3)
    assert running.dtype == np.uint8
    env.step(Action.PLUS_X)
    env.step(Action.PLUS_X)
    ended = env.render()
    assert tuple(running[0, 0]) != tuple(ended[0, 0])
    middle = 6 + 2 * 24 + 12
    assert tuple(running[middle, middle]) == (28, 32, 38)
    assert tuple(ended[middle, middle + 2 * 24]) == (28, 32, 38)


def test_without_a_render_mode_there_is_no_picture():
    env = FlatCable("K1")
    env.reset(seed=1)
    assert env.render() is None


def test_what_cannot_be_is_said_in_one_line():
    with pytest.raises(UnknownWorldError, match="there are G0"):
        FlatCable("K9")
    with pytest.raises(ValueError, match="rgb_array"):
        FlatCable("K1", render_mode="human")
    env = FlatCable("K1")
    env.reset(seed=1)
    with pytest.raises(ValueError, match="0 to 5, found 6"):
        env.step(6)


def test_closing_the_environment_closes_its_world():
    class Cell(SlotWorld):
        closed = False

        def close(self):
            self.closed = True

    world = Cell(Model((2, 2, 1)))
    FlatCable(world).close()
    assert world.closed


def test_importing_registers_nothing():
    code = (
        "import gymnasium, learner.environment.registration as r; "
        "assert r.NAME not in gymnasium.registry; r.register(); r.register(); "
        "assert r.NAME in gymnasium.registry"
    )
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)
    assert NAME.startswith("hil/")
