"""The learner's process: the only writer of every table, and its n agents in one compiled loop."""

import os
from multiprocessing.connection import Connection
from typing import Final, NamedTuple

import numpy as np

from controller.outcome import Kind
from learner.beside.memory import Layout, Memory
from learner.beside.ring import Record
from learner.grid import Grid
from learner.interface import State
from learner.parallel.wdql import Parallel, ParallelLearner
from learner.tabular.alone import Rows

ENDINGS: Final = (Kind.INSERTED, Kind.DANGER, Kind.LIMIT)
CHUNK: Final = 2_000
"""Rounds of all agents between two looks at the ring: 1.2 ms at 10 million updates a second."""
NICE: Final = 10
REST: Final = 0.002
"""Seconds to wait for the ring while there is nothing to simulate yet."""


class Task(NamedTuple):
    """What the process is started with; state: where to begin, None for nothing learnt."""

    layout: Layout
    grid: Grid
    settings: Parallel
    seed: int
    state: State | None


def serve(task: Task, pipe: Connection) -> None:
    """Learn until the pipe says stop or breaks; then send what was learnt through it."""
    os.nice(NICE)
    memory = Memory.attach(task.layout)
    learner = ParallelLearner(task.grid, task.settings, np.random.default_rng(task.seed))
    if task.state is not None:
        learner.load(task.state)
    try:
        _run(memory, pipe, learner)
    except EOFError:
        return  # the control process is gone
    finally:
        memory.close()
    pipe.send(learner.save())


def _run(memory: Memory, pipe: Connection, learner: ParallelLearner) -> None:
    memory.policy.publish(learner.greedy())
    while True:
        busy = learner.simulate(CHUNK)
        while (record := memory.ring.take()) is not None:
            learner.take_in(met(record))
            busy = True
        if busy:
            memory.policy.publish(learner.greedy())
        if pipe.poll(0.0 if busy else REST):
            pipe.recv()
            return


def met(record: Record) -> Rows:
    """A record as the learner takes it."""
    ending = None if record.ending < 0 else ENDINGS[record.ending]
    return Rows(record.before, record.action, record.after, record.step, ending)
