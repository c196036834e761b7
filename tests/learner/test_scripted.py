import numpy as np
import pytest

from controller.settings import Search
from learner.scripted import RandomPolicy, pose_script, spiral_script
from learner.task import Action, Observation

SEARCH = Search()
SIZES = (SEARCH.step, SEARCH.step, SEARCH.step_rotation)


def walk(policy, start, steps):
    """Cells (x, y, theta) visited when every step is taken as asked."""
    cell = list(start)
    visited = [tuple(cell)]
    for _ in range(steps):
        x, y, theta = (c * s for c, s in zip(cell, SIZES, strict=True))
        action = policy.choose(Observation(0.0, 0.0, 5.0, 0.0, x, y, 0.0, theta))
        cell[action.axis] += action.sign
        visited.append(tuple(cell))
    return visited


@pytest.mark.parametrize("start", [(8, 8, 6), (-8, 3, -6), (0, 0, 0), (5, -8, 1)])
def test_the_pose_script_straightens_first_and_then_passes_the_slot(start):
    visited = walk(pose_script(SEARCH, start[1] * SEARCH.step), start, 40)
    assert visited[abs(start[2])][2] == 0
    assert (0, 0, 0) in visited


def test_the_pose_script_covers_every_offset_that_a_grip_can_have():
    visited = set(walk(pose_script(SEARCH, 0.0), (0, 0, 0), 300))
    assert {(x, y, t) for x in (-1, 0, 1) for y in range(-3, 4) for t in (-1, 0, 1)} <= visited


def test_the_pose_script_keeps_searching_to_k_max():
    assert len(walk(pose_script(SEARCH, 0.0), (0, 0, 0), 500)) == 501


def test_the_spiral_visits_each_cell_of_the_square_around_the_slot():
    visited = set(walk(spiral_script(SEARCH), (3, -2, 1), 200))
    assert {(x, y, 0) for x in range(-3, 4) for y in range(-3, 4)} <= visited


def test_a_random_policy_is_its_generators():
    def actions(seed):
        policy = RandomPolicy(np.random.default_rng(seed))
        return [policy.choose(Observation(*[0.0] * 8)) for _ in range(200)]

    assert actions(1) == actions(1)
    assert actions(1) != actions(2)
    assert set(actions(1)) == set(Action)
