"""The neural baselines; skipped where torch and stable-baselines3 are not installed."""

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="needs the extra 'baselines'")
sb3 = pytest.importorskip("stable_baselines3", reason="needs the extra 'baselines'")

from controller.outcome import Kind  # noqa: E402
from learner.build import maker  # noqa: E402
from learner.checkpoint import Checkpoint, decode, encode  # noqa: E402
from learner.environment.flat_cable import FlatCable  # noqa: E402
from learner.episode import Episode  # noqa: E402
from learner.errors import CheckpointError  # noqa: E402
from learner.neural import dql, on_policy  # noqa: E402
from learner.neural.dice import Dice  # noqa: E402
from learner.neural.pg import returns  # noqa: E402
from learner.neural.settings import Method, Neural  # noqa: E402
from learner.worlds.evaluate import Protocol, evaluate  # noqa: E402
from learner.worlds.model import Model  # noqa: E402
from learner.worlds.slot import SlotWorld  # noqa: E402

SMALL = {"units": 8, "warm_up": 20, "renewal": 10}
METHODS = [method.value for method in Method]
EASY = Model((2, 2, 1), (1, 0, 0), max_steps=40, hazard=0.01)


def learner_for(world, name, seed=1, **values):
    make = maker(name, {**SMALL, **values})
    return make(world.grid, world.max_steps, np.random.default_rng(seed))


def results(world, learner, episodes=4, seed=1):
    return list(evaluate(learner, world, Protocol(episodes, 0), np.random.default_rng(seed)))


def weights(policy):
    return {name: value.numpy().copy() for name, value in policy.state_dict().items()}


def pushed_through(learner, seed, steps):
    """The learner on the environment's own episodes, by its own calls."""
    env = FlatCable(SlotWorld(EASY))
    env.reset(seed=seed)
    world, taken = env.world, 0
    while taken < steps:
        policy, seen = Episode(learner), world.begin()
        while taken < steps:
            met = world.step(policy.choose(seen))
            taken += 1
            seen = met.observation
            if met.ending is not None:
                policy.end(seen, met.ending)
                break
            if taken == steps:
                policy.end(seen, Kind.FAULT)  # cut off: teaches nothing
    return learner


def libraries_own(module, settings, seed, steps):
    """stable-baselines3's own loop on the gymnasium environment, with the same numbers drawn."""
    number = int(np.random.default_rng(1).integers(1 << 32))
    dice = Dice(number)
    env = FlatCable(SlotWorld(EASY))
    first = env.reset
    env.reset = lambda **_: first(seed=seed) if env._fresh else first()
    with dice.thrown():
        model = module.model(env, settings)
        model.action_space.seed(number)
        model.learn(steps)
    return model


@pytest.mark.parametrize("method", [Method.DQL, Method.AC, Method.PPO])
def test_a_learner_shown_its_steps_becomes_what_the_librarys_own_loop_makes(method):
    settings, steps = Neural(method, max_steps=EASY.max_steps, rollout=8, **SMALL), 120
    module = dql if method is Method.DQL else on_policy
    kind = dql.DqlLearner if method is Method.DQL else on_policy.OnPolicyLearner
    ours = kind(SlotWorld(EASY).grid, settings, np.random.default_rng(1))
    # One step more: the library learns before it would act, here a step is seen when it is over.
    pushed_through(ours, seed=3, steps=steps + 1)
    theirs = libraries_own(module, settings, seed=3, steps=steps)
    for name, value in weights(theirs.policy).items():
        assert np.array_equal(weights(ours.model.policy)[name], value), name


@pytest.mark.parametrize("name", METHODS)
def test_the_same_seed_gives_the_same_steps_whatever_the_process_draws(name):
    world = SlotWorld(EASY)
    first = results(world, learner_for(world, name))
    torch.rand(7)
    np.random.random(7)
    assert results(world, learner_for(world, name)) == first


@pytest.mark.parametrize("name", METHODS)
def test_a_learner_leaves_the_processs_generators_alone(name):
    np.random.seed(5)
    torch.manual_seed(5)
    expected = np.random.random(), float(torch.rand(1))
    np.random.seed(5)
    torch.manual_seed(5)
    threads = torch.get_num_threads()
    world = SlotWorld(EASY)
    results(world, learner_for(world, name), episodes=2)
    assert (np.random.random(), float(torch.rand(1))) == expected
    assert torch.get_num_threads() == threads


@pytest.mark.parametrize("name", METHODS)
def test_a_learner_restored_in_the_middle_goes_on_as_if_there_had_been_no_break(name):
    world, other = SlotWorld(EASY), SlotWorld(EASY)
    whole, first = learner_for(world, name), learner_for(other, name)
    results(world, whole)
    results(other, first)
    revived = learner_for(other, name, seed=99)
    file = Checkpoint(name, {}, "easy", 1, 4, {}, first.save())
    revived.load(decode(encode(file)).state)
    assert results(world, whole, seed=2) == results(other, revived, seed=2)


@pytest.mark.parametrize("name", METHODS)
def test_a_state_of_another_net_is_refused(name):
    world = SlotWorld(EASY)
    with pytest.raises(CheckpointError, match="this learner's"):
        learner_for(world, name).load(learner_for(world, name, units=9).save())
    with pytest.raises(CheckpointError, match="neural learner"):
        learner_for(world, name).load({})


def test_every_method_learns_the_way_to_a_slot_beside_the_start():
    world = SlotWorld(Model((1, 0, 0), (1, 0, 0), max_steps=30, mirrored=False))
    for name in METHODS:
        late = results(world, learner_for(world, name, rollout=8), episodes=60)[40:]
        assert np.mean([result.steps for result in late]) < 5.0, name


def test_returns_are_eq_3():
    assert returns(np.array([0.0, 0.0, 1.0]), 0.5).tolist() == [0.25, 0.5, 1.0]


@pytest.mark.parametrize(
    "wrong", [{"learning_rate": 0.0}, {"gamma": 1.0}, {"greedy": 2.0}, {"units": 0}]
)
def test_settings_that_make_no_learner_are_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Neural(Method.DQL, **wrong)
