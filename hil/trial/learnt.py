"""A learner that chooses a trial's search steps, after some practice on the fast world."""

from dataclasses import replace
from typing import Final

from hil.cell.rig import Rig
from hil.cell.streams import stream
from learner.build import maker
from learner.grid import Grid
from learner.interface import Learner
from learner.worlds.evaluate import Protocol, evaluate
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld

PRACTICE: Final = Protocol(training=12, verification=0)
"""Episodes before the trial: agents wait for a first success, and what nothing depends on yet
cannot be missed."""


def learnt(name: str, rig: Rig, seed: int) -> Learner:
    """The learner of this name; UnknownLearnerError. The fast world's slot is not the rig's."""
    task = rig.task
    grid = Grid(task.search_cells, (task.step, task.step, task.step_rotation))
    learner = maker(name)(grid, task.max_steps, stream(seed, "learner"))
    world = SlotWorld(replace(model("ffc"), halves=task.search_cells))
    for _ in evaluate(learner, world, PRACTICE, stream(seed, "practice")):
        pass
    return learner
