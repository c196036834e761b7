"""The control process's end of a learner beside it: a Learner that never computes."""

from multiprocessing import get_context
from typing import Self

import numpy as np

from controller.action import Action, Observation
from learner.beside.memory import Memory
from learner.beside.process import ENDINGS, Task, serve
from learner.beside.ring import Record
from learner.errors import LearnerGoneError
from learner.grid import Grid
from learner.interface import State, Transition
from learner.parallel.wdql import Parallel
from learner.tabular.alone import rows


class BesideLearner:
    """Algorithm 1 with free-running agents; what it learns depends on the clock, not on the seed
    alone. Use it as a context manager: it owns a process and a block of shared memory.
    """

    def __init__(
        self,
        grid: Grid,
        settings: Parallel,
        rng: np.random.Generator,
        state: State | None = None,
    ) -> None:
        self._grid, self._settings, self._rng = grid, settings, rng
        self._memory = Memory(grid.states)
        context = get_context("spawn")
        self._pipe, far = context.Pipe()
        task = Task(self._memory.layout, grid, settings, int(rng.integers(1 << 62)), state)
        self._process = context.Process(target=serve, args=(task, far), daemon=True)
        self._process.start()
        far.close()

    @property
    def version(self) -> int:
        """How many policies have been published."""
        return self._memory.policy.version

    def begin(self) -> None:
        """Raises LearnerGoneError: an episode needs a living learner."""
        if not self._process.is_alive():
            raise LearnerGoneError(f"the learner's process ended with {self._process.exitcode}")

    def act(self, observation: Observation) -> Action:
        """Eq. 5 on the newest published policy; any action before there is one."""
        if self.version and self._rng.random() < self._settings.tabular.greedy:
            return Action(self._memory.policy.action(self._grid.row(self._grid.cell(observation))))
        return Action(int(self._rng.integers(len(Action))))

    def observe(self, transition: Transition) -> None:
        """Hand the step over; never waits."""
        before, action, after, step, ending = rows(self._grid, transition)
        how = -1 if ending is None else ENDINGS.index(ending)
        self._memory.ring.put(Record(before, action, after, step, how))

    def grip_changed(self) -> None:
        """Nothing: the paper's tables point where they pointed."""

    def save(self) -> State:
        """Stop the process and take what it learnt; the learner cannot be used after it."""
        try:
            self._pipe.send("stop")
            state: State = self._pipe.recv()
        except (EOFError, OSError):
            self._process.join()
            raise LearnerGoneError(
                f"the learner's process ended with {self._process.exitcode}"
            ) from None
        self._process.join()
        return state

    def load(self, state: State) -> None:
        """A saved state is taken up at the start only."""
        raise NotImplementedError("give the state to the constructor: the process has its own")

    def close(self) -> None:
        """End the process, whatever it is doing, and free the memory."""
        self._pipe.close()
        self._process.terminate()
        self._process.join()
        self._process.close()
        self._memory.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
