import subprocess
import sys
from contextlib import ExitStack

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="needs the extra 'gym'")

from gymnasium.utils.env_checker import check_env  # noqa: E402

from controller.action import Action  # noqa: E402
from controller.outcome import Kind  # noqa: E402
from hil.app.environment import register  # noqa: E402
from hil.app.inline import InlineCell  # noqa: E402
from hil.app.train import Schedule, connected  # noqa: E402
from hil.app.world import CellWorld  # noqa: E402
from hil_fixtures.testbed import shipped  # noqa: E402
from learner.build import maker  # noqa: E402
from learner.worlds.evaluate import Protocol, evaluate  # noqa: E402


def small(steps):
    rig = shipped("ffc_learning")
    return rig.model_copy(update={"task": rig.task.model_copy(update={"max_steps": steps})})


@pytest.fixture
def world():
    opened = CellWorld(small(3))
    yield opened
    opened.close()


def search(grid):
    return maker("search")(grid, 6, np.random.default_rng(0))


def test_gymnasiums_own_checker_finds_nothing_on_the_whole_cell():
    env = gymnasium.make(register(), rig=small(3), render_mode="rgb_array").unwrapped
    check_env(env)
    env.close()


def test_a_learner_meets_the_same_episodes_through_the_world_as_through_a_training():
    rig, seed = small(6), int(np.random.default_rng(5).integers(1 << 31))
    world = CellWorld(rig)
    met = evaluate(search(world.grid), world, Protocol(2, 1), np.random.default_rng(5))
    through_world = [(one.kind, one.steps) for one in met]
    world.close()
    with InlineCell(rig, seed, "lockstep", record=False) as cell, ExitStack() as stack:
        trainer = connected(rig, cell, stack, lambda *_: None, None)
        trained = trainer.run(search(world.grid), Schedule((("FFC1", 2), ("FFC2", 1))), seed)
        assert [(one.kind, one.steps) for one in trained] == through_world


def test_an_episode_left_in_the_middle_is_given_up_and_the_next_one_is_whole(world):
    world.reset(np.random.default_rng(1))
    world.begin()
    world.step(Action.PLUS_X)
    world.begin()
    endings = [world.step(Action.PLUS_X).ending for _ in range(3)]
    assert endings == [None, None, Kind.LIMIT]
    with pytest.raises(ValueError, match="begin another one"):
        world.step(Action.PLUS_X)


def test_every_step_moves_the_jaws_one_cell_and_the_part_comes_after(world):
    world.reset(np.random.default_rng(2))
    seen, off = world.begin(), world.error
    for _ in range(2):
        before, seen = seen, world.step(Action.MINUS_Y).observation
        assert world.grid.cell(seen)[1] - world.grid.cell(before)[1] == -1
    assert world.error[1] < off[1] - 0.3


def test_a_world_of_real_devices_is_refused():
    rig = shipped("ffc_learning").model_copy(update={"rig": "real"})
    with pytest.raises(ValueError, match="real devices do not"):
        CellWorld(rig)


def test_an_environment_that_nobody_closed_lets_the_interpreter_end():
    code = (
        "from hil.app.environment import over_the_wire; "
        "from hil_fixtures.testbed import shipped; "
        "env = over_the_wire(shipped('ffc_learning')); env.reset(seed=1); env.step(0)"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)
