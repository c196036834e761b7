import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from learner.tabular.dice import uniform, words
from learner.tabular.rules import (
    DOUBLE,
    SINGLE,
    WEIGHTED,
    Law,
    Pool,
    Step,
    choose,
    greedy,
    update,
    weight,
)
from learner.tabular.tables import empty

LAW = Law(WEIGHTED, 0.01, 0.9, 1.0, 0.85, True)
VALUES = st.floats(-1.0, 1.0)


def pool(states=4, seed=0):
    return empty(states, 0, np.random.default_rng(seed))


def filled(values, seed=0):
    one = pool(seed=seed)
    one.q1[...], one.q2[...] = np.array(values).reshape(2, 4, 6)
    return one


TABLES = st.lists(VALUES, min_size=48, max_size=48)
STEPS = st.builds(
    Step, st.integers(0, 3), st.integers(0, 5), st.integers(0, 3), VALUES, st.booleans()
)


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(1e-300, 1e300))
def test_a_weight_is_at_least_zero_and_below_one(best, worst, c):
    assert 0.0 <= weight(best, worst, c) < 1.0


def test_a_weight_follows_equation_7():
    assert weight(0.5, -0.25, 0.25) == pytest.approx(0.75 / (0.25 + 0.75))


@given(TABLES, st.lists(STEPS, max_size=30), st.sampled_from([SINGLE, DOUBLE, WEIGHTED]))
def test_values_of_terminal_rewards_within_one_stay_within_one(values, steps, rule):
    one = filled(values)
    for step in steps:
        paid = step.paid if step.over else 0.0
        update(one, LAW._replace(rule=rule, psi=0.5), step._replace(paid=paid), 0)
    assert np.abs(one.q1).max() <= 1.0
    assert np.abs(one.q2).max() <= 1.0


@given(TABLES, STEPS, st.sampled_from([DOUBLE, WEIGHTED]))
def test_an_update_changes_one_entry_of_one_table(values, step, rule):
    one = filled(values)
    before = np.stack([one.q1, one.q2])
    update(one, LAW._replace(rule=rule, psi=0.5), step, 0)
    changed = np.argwhere(np.stack([one.q1, one.q2]) != before)
    assert len(changed) <= 1
    if len(changed):
        assert tuple(changed[0][1:]) == (step.before, step.action)


@given(TABLES, STEPS)
def test_plain_q_learning_never_touches_the_second_table(values, step):
    one = filled(values)
    second = one.q2.copy()
    update(one, LAW._replace(rule=SINGLE), step, 0)
    assert np.array_equal(one.q2, second)


def test_weighted_is_the_mean_of_own_and_other_worth():
    one = pool()
    one.q1[1], one.q2[1] = (0.8, 0, 0, 0, 0, -0.2), (0.4, 0, 0, 0, 0, -0.1)
    other = pool()
    other.q1[1], other.q2[1] = one.q2[1], one.q1[1]  # the same whichever table is drawn
    for a in (one, other):
        before = a.q1.copy(), a.q2.copy()
        update(a, LAW._replace(psi=1.0), Step(0, 2, 1, 0.0, False), 0)
        own, theirs = (before[0], before[1]) if a.q1[0, 2] else (before[1], before[0])
        beta = weight(theirs[1, 0], theirs[1, 5], 1.0)
        found = a.q1[0, 2] or a.q2[0, 2]
        assert found == pytest.approx(0.9 * (beta * own[1, 0] + (1 - beta) * theirs[1, 0]))


def test_an_infinite_c_is_double_q_learning():
    rng = np.random.default_rng(1)
    values = rng.uniform(-1, 1, 48)
    a, b = filled(values), filled(values)
    for _ in range(200):
        step = Step(*map(int, rng.integers(0, (4, 6, 4))), 0.0, False)
        update(a, LAW._replace(c=np.inf), step, 0)
        update(b, LAW._replace(rule=DOUBLE), step, 0)
    assert np.array_equal(a.q1, b.q1)
    assert np.array_equal(a.q2, b.q2)


@given(
    st.integers(0, 2**32 - 1),
    st.lists(STEPS, max_size=30),
    st.sampled_from([SINGLE, DOUBLE, WEIGHTED]),
)
def test_a_potential_moves_every_value_by_itself_and_no_greedy_action(seed, steps, rule):
    """Ng, Harada and Russell 1999; Wiewiora 2003 for tables that begin at minus the potential."""
    rng = np.random.default_rng(seed)
    values, potential = rng.uniform(-1, 1, 48), rng.uniform(-1, 1, 4)
    law = LAW._replace(rule=rule, psi=0.5)
    plain, shaped = filled(values), filled(values)
    shaped.q1[...] -= potential[:, None]
    shaped.q2[...] -= potential[:, None]
    for step in steps:
        ahead = 0.0 if step.over else law.gamma * potential[step.after]
        update(plain, law, step, 0)
        update(shaped, law, step._replace(paid=step.paid + ahead - potential[step.before]), 0)
    assert shaped.q1 + potential[:, None] == pytest.approx(plain.q1, abs=1e-9)
    assert shaped.q2 + potential[:, None] == pytest.approx(plain.q2, abs=1e-9)
    assert np.array_equal(greedy(shaped, law), greedy(plain, law))


def test_a_large_c_is_not_double_q_learning():
    """A weight of 1e-300 still decides between values that double Q-learning finds equal."""
    rng = np.random.default_rng(3)
    a, b = pool(), pool()
    for _ in range(400):
        step = Step(*map(int, rng.integers(0, (4, 6, 4))), float(rng.choice([0, 1])), False)
        update(a, LAW._replace(c=1e300), step, 0)
        update(b, LAW._replace(rule=DOUBLE), step, 0)
    assert not np.array_equal(a.q1, b.q1)


@given(st.lists(st.floats(), min_size=48, max_size=48), st.booleans())
def test_whatever_is_in_the_tables_the_choice_is_one_of_the_six(values, random_ties):
    one = filled(values)
    for row in range(4):
        assert choose(one, LAW._replace(random_ties=random_ties), row, 0) in range(6)


def test_an_untrained_table_takes_every_action_about_equally():
    one = pool()
    taken = np.bincount([choose(one, LAW, 0, 0) for _ in range(6000)], minlength=6)
    assert taken.min() > 850


def test_without_random_ties_an_untrained_table_knows_one_action():
    law = LAW._replace(random_ties=False, greedy=1.0)
    one = pool()
    assert {choose(one, law, 0, 0) for _ in range(50)} == {0}


@given(st.floats(0.1, 10.0), TABLES)
def test_the_greedy_action_does_not_depend_on_the_scale_of_rewards(factor, values):
    law = LAW._replace(greedy=1.0)
    a = filled(values)
    total = a.q1 + a.q2
    b = Pool(a.q1 * factor, a.q2 * factor, a.dice.copy())
    scaled = b.q1 + b.q2
    for row in range(4):
        if np.sum(total[row] == total[row].max()) == np.sum(scaled[row] == scaled[row].max()) == 1:
            assert choose(a, law, row, 0) == choose(b, law, row, 0)


def test_dice_are_uniform_and_one_word_does_not_move_another():
    state = words(np.random.default_rng(3), 2)
    other = state[1]
    numbers = np.array([uniform(state, 0) for _ in range(20000)])
    assert state[1] == other
    assert abs(numbers.mean() - 0.5) < 0.01
    assert 0.0 <= numbers.min() < numbers.max() < 1.0
    assert abs(np.corrcoef(numbers[:-1], numbers[1:])[0, 1]) < 0.02
