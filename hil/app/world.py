"""The whole cell as a world: a call a step, while everything behind it goes over the wire."""

import atexit
from contextlib import ExitStack
from itertools import cycle
from queue import SimpleQueue
from threading import Thread

import numpy as np

from controller.action import Action, Observation
from hil.app.cell import RunningCell
from hil.app.inline import InlineCell
from hil.app.near import part_named, start_plan
from hil.app.train import Attempt, Trainer, connected
from hil.cell.errors import CellError
from hil.cell.rig import Rig
from learner.episode import ENDINGS
from learner.grid import Grid
from learner.worlds.interface import Met


class Asked:
    """A policy in the control loop's thread that hands each question out and waits for the answer.

    One of the two threads always waits. In lockstep the cell's clock stands still meanwhile, so it
    is no matter how long the answer takes.
    """

    def __init__(self) -> None:
        self.news: SimpleQueue[Observation | Attempt | BaseException] = SimpleQueue()
        self.answers: SimpleQueue[Action | None] = SimpleQueue()

    def choose(self, observation: Observation) -> Action | None:
        """What the other side answers; None gives the episode up."""
        self.news.put(observation)
        return self.answers.get()


class CellWorld:
    """A rig's cell in this process, its drivers and its control loop, as `learner.worlds` has it.

    Nothing is opened before `reset`, which opens a cell of its own each time; `close` what is open.
    A part that meets the slot before any step ends the episode with the first one, not taken.
    """

    def __init__(self, rig: Rig) -> None:
        """ValueError for a rig of real devices: there nobody may think while the part is pressed.

        CellError from any call when the cell itself fails.
        """
        if rig.rig == "real":
            raise ValueError(f"{rig.name}: a world steps in lockstep, which real devices do not")
        task = rig.task
        self._rig = rig.on_free_ports()
        self.grid = Grid(task.search_cells, (task.step, task.step, task.step_rotation))
        self.max_steps = task.max_steps
        self._open: ExitStack | None = None
        self._asked: Asked | None = None
        self._ended: Attempt | None = None

    def reset(self, rng: np.random.Generator) -> None:
        """A cell anew, its offsets and noise from `rng`, and its first part in the jaws."""
        self.close()
        self._seed = int(rng.integers(1 << 31))
        self._parts = cycle(part.name for part in self._rig.fixture.parts)
        with ExitStack() as stack:
            self._cell = stack.enter_context(
                InlineCell(self._rig, self._seed, "lockstep", record=False)
            )
            self._trainer: Trainer = connected(self._rig, self._cell, stack, _watch_nothing, None)
            self._open = stack.pop_all()
        # Threads that stand in physics while the interpreter ends take it down with them.
        atexit.register(self.close)
        self._fetch()

    def regrip(self) -> None:
        """Put the part back and fetch the next one of the fixture."""
        self._give_up()
        self._trainer.bring_back(self._plan, self._part)
        self._fetch()

    def begin(self) -> Observation:
        """To the start pose and into contact; an episode under way is given up."""
        self._give_up()
        self._asked = Asked()
        Thread(target=self._attempt, args=(self._asked,), name="episode", daemon=True).start()
        news = self._hear(self._asked)
        self._ended = news if isinstance(news, Attempt) else None
        return news.seen if isinstance(news, Attempt) else news

    def step(self, action: Action) -> Met:
        """One step of the arm, settled; ValueError after an episode's end."""
        asked = self._asked
        if asked is None:
            raise ValueError("the episode is over: begin another one")
        news: Observation | Attempt | None = self._ended
        if news is None:
            asked.answers.put(action)
            news = self._hear(asked)
        if not isinstance(news, Attempt):
            return Met(news, None)
        self._asked = None
        if news.outcome.kind not in ENDINGS:
            raise CellError(f"{news.outcome.kind.value}: {news.outcome.reason}")
        return Met(news.seen, news.outcome.kind)

    @property
    def error(self) -> tuple[float, float, float]:
        """From the slot to the tip, in steps, as only an emulated cell can tell."""
        part = self._cell.truth().part
        x, y, turn = np.divide((*part.tip[:2], part.theta), self.grid.sizes).tolist()
        return x, y, turn

    def close(self) -> None:
        """End the episode, the drivers and the cell, as far as there are any."""
        atexit.unregister(self.close)
        with ExitStack() as stack:
            if self._open is not None:
                stack.enter_context(self._open)
                self._open = None
            self._give_up()

    def _fetch(self) -> None:
        self._part = next(self._parts)
        self._plan = start_plan(self._rig, part_named(self._rig, self._part), self._seed)
        self._trainer.fetch(self._plan, self._part)

    def _attempt(self, asked: Asked) -> None:
        try:
            asked.news.put(self._trainer.attempt(self._plan, self._part, asked))
        except BaseException as error:
            asked.news.put(error)

    def _hear(self, asked: Asked) -> Observation | Attempt:
        news = asked.news.get()
        if isinstance(news, BaseException):
            self._asked = None
            raise news
        return news

    def _give_up(self) -> None:
        """Let an episode under way come to its end."""
        asked, self._asked = self._asked, None
        if asked is None or self._ended is not None:
            return
        asked.answers.put(None)
        while isinstance(self._hear(asked), Observation):
            asked.answers.put(None)


def _watch_nothing(_cycle: object, _course: object, _cell: RunningCell) -> None:
    """No screen and no referee."""
