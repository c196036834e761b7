"""What holds for every learner and for the agents of Algorithm 1, whatever happens to them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.action import Action
from controller.outcome import Kind
from learner.build import maker
from learner.checkpoint import Checkpoint, decode, encode
from learner.episode import Episode
from learner.errors import CheckpointError
from learner.grid import Cell, Grid
from learner.parallel.agents import Agents
from learner.parallel.outcomes import DANGER, FAIL, SUCCESS
from learner.parallel.server import train
from learner.tabular.rules import Step, choose, update
from learner.tabular.settings import Rule, Tabular
from learner.tabular.tables import empty
from learner.task import reward
from learner.worlds.model import Model
from learner.worlds.slot import SlotWorld

NAMES = ("ql", "double-ql", "wdql-alone", "wdql", "belief", "search")
GRID = Grid((2, 2, 1), (0.3e-3, 0.3e-3, 0.0175))
WORLD = Model((2, 2, 1), (1, 1, 0), max_steps=30, hazard=0.02, insertion=0.7)
START = GRID.row(Cell(0, 0, 0))
SEEDS = st.integers(0, 2**32 - 1)
LABELS = st.lists(st.sampled_from([FAIL, FAIL, SUCCESS, DANGER]), min_size=75, max_size=75)
RULES = st.builds(
    Tabular,
    rule=st.sampled_from(Rule),
    psi=st.floats(0.001, 1.0),
    gamma=st.floats(0.0, 0.99),
    greedy=st.floats(0.0, 1.0),
    c=st.floats(1e-6, 1e6),
    max_steps=st.integers(1, 40),
)


def agents_on(labels, seed, count):
    classes = np.array(labels, np.int8)
    classes[START] = FAIL  # the start: an episode begins where nothing happened
    pool = empty(GRID.states, count, np.random.default_rng(seed))
    return classes, Agents.at((0, 0, 0), count), pool


@given(LABELS, SEEDS, st.integers(1, 6), RULES)
@settings(max_examples=60, deadline=None)
def test_simulated_values_stay_within_what_eq_4_pays(labels, seed, count, rules):
    classes, agents, pool = agents_on(labels, seed, count)
    agents.run(pool, GRID, classes, rules, 200)
    lowest = -1.0 if DANGER in classes else -0.5
    for table in (pool.q1, pool.q2):
        assert table.max() <= 1.0
        assert table.min() >= lowest


@given(LABELS, SEEDS, st.integers(1, 6), RULES)
@settings(max_examples=60, deadline=None)
def test_danger_and_success_always_end_a_simulated_episode(labels, seed, count, rules):
    classes, agents, pool = agents_on(labels, seed, count)
    for _ in range(60):
        before = agents.steps.copy()
        agents.run(pool, GRID, classes, rules, 1)
        for place, steps, earlier in zip(agents.places, agents.steps, before, strict=True):
            assert steps in {0, earlier + 1}
            assert 0 <= steps < rules.max_steps
            ended = not place.any() and steps == 0
            assert ended or classes[GRID.row(Cell(*map(int, place)))] == FAIL


@given(LABELS, SEEDS, st.integers(1, 4), RULES)
@settings(max_examples=25, deadline=None)
def test_the_agents_learn_in_turn_and_no_update_is_lost(labels, seed, count, rules):
    classes, agents, pool = agents_on(labels, seed, count)
    agents.run(pool, GRID, classes, rules, 20)
    mine = empty(GRID.states, count, np.random.default_rng(seed))
    cells, steps, law = [Cell(0, 0, 0)] * count, [0] * count, rules.law
    for _ in range(20):
        for i in range(count):
            row = GRID.row(cells[i])
            action = choose(mine, law, row, i + 1)
            after = GRID.moved(cells[i], Action(action))
            steps[i] += 1
            paid, over = paid_for(classes[GRID.row(after)], steps[i], rules.max_steps)
            update(mine, law, Step(row, action, GRID.row(after), paid, over), i + 1)
            cells[i], steps[i] = (Cell(0, 0, 0), 0) if over else (after, steps[i])
    assert np.array_equal(pool.q1, mine.q1)
    assert np.array_equal(pool.q2, mine.q2)


def paid_for(label, step, max_steps):
    kinds = {SUCCESS: Kind.INSERTED, DANGER: Kind.DANGER}
    kind = kinds.get(label, Kind.LIMIT if step >= max_steps else None)
    return (0.0, False) if kind is None else (reward(kind, step, max_steps), True)


@given(st.integers(1, 500), st.integers(1, 500))
def test_the_three_endings_never_pay_alike(step, max_steps):
    step = min(step, max_steps)
    inserted, limit, danger = (
        reward(kind, step, max_steps) for kind in (Kind.INSERTED, Kind.LIMIT, Kind.DANGER)
    )
    assert 0.0 <= inserted < 1.0
    assert (limit, danger) == (-0.5, -1.0)


@given(st.integers(0, 2), st.lists(st.integers(0, 9), min_size=4, max_size=4))
def test_a_classifier_refuses_outcomes_of_one_class(label, times):
    counts = np.zeros((4, 3), np.int64)
    counts[:, label] = times
    with pytest.raises(ValueError, match="at least two classes"):
        train(np.ones((4, 2)), counts)


def walked(learner, world, steps):
    """So many steps, episode after episode; the actions."""
    taken, policy, seen = [], Episode(learner), world.begin()
    for _ in range(steps):
        taken.append(policy.choose(seen))
        met = world.step(taken[-1])
        seen = met.observation
        if met.ending is not None:
            policy.end(seen, met.ending)
            policy, seen = Episode(learner), world.begin()
    return taken


@pytest.mark.parametrize("name", NAMES)
@given(SEEDS, st.integers(1, 80))
@settings(max_examples=8, deadline=None)
def test_the_same_seed_repeats_and_every_action_is_one_of_the_six(name, seed, steps):
    found = []
    for _ in range(2):
        world = SlotWorld(WORLD)
        world.reset(np.random.default_rng(seed))
        learner = maker(name)(world.grid, world.max_steps, np.random.default_rng(seed))
        found.append(walked(learner, world, steps))
    assert found[0] == found[1]
    assert set(found[0]) <= set(Action)


@pytest.mark.parametrize("name", NAMES)
@given(SEEDS, st.integers(1, 80))
@settings(max_examples=8, deadline=None)
def test_a_checkpoint_at_any_step_goes_on_like_the_learner_that_wrote_it(name, seed, steps):
    world = SlotWorld(WORLD)
    world.reset(np.random.default_rng(seed))
    learner, revived = (
        maker(name)(world.grid, world.max_steps, np.random.default_rng(s)) for s in (seed, 7)
    )
    walked(learner, world, steps)
    revived.load(decode(encode(Checkpoint(name, {}, "w", seed, 0, {}, learner.save()))).state)
    further = []
    for each in (learner, revived):
        again = SlotWorld(WORLD)
        again.reset(np.random.default_rng(seed + 1))
        further.append(walked(each, again, 40))
    assert further[0] == further[1]


def floats(state):
    """Every array of floats that a learner remembers, wherever it lies."""
    for value in state.values():
        if isinstance(value, dict):
            yield from floats(value)
        elif isinstance(value, np.ndarray) and value.dtype.kind == "f":
            yield value


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
@pytest.mark.parametrize("name", ["ql", "double-ql", "wdql-alone", "wdql", "belief"])
def test_a_policy_of_values_that_are_not_finite_is_refused(name, wrong):
    made = maker(name)
    state = made(GRID, 30, np.random.default_rng(1)).save()
    tables = list(floats(state))
    assert tables
    for table in tables:
        kept, table.flat[-1] = table.flat[-1], wrong
        with pytest.raises(CheckpointError, match="not finite"):
            made(GRID, 30, np.random.default_rng(1)).load(state)
        table.flat[-1] = kept
    made(GRID, 30, np.random.default_rng(1)).load(state)
