"""The paper's experiment on one cell: train with one part, then verify with another.

Section 4.2: pick up the first part, so many episodes with it, put it back, pick up the next one,
which lies otherwise in the jaws, and a few episodes more.
"""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

from controller.action import Observation, Policy, observation
from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.job import bring_back, fetch, held_episode, leave
from controller.loop import Loop
from controller.outcome import Ending, Kind, Outcome
from controller.place import Place
from controller.settings import Plan
from controller.start import bring_up
from hil.app.cell import RunningCell
from hil.app.host_faults import HostFaults
from hil.app.learner_faults import FaultyPolicy, Pieces
from hil.app.near import NearSide, limits, load, near_side, part_named, start_plan, task_frame
from hil.app.record import RunRecord
from hil.app.watched import watched
from hil.cell.errors import CellError
from hil.cell.rig import Rig
from learner.episode import ENDINGS, Episode
from learner.interface import Checked, Learner

TRIES = 3
"""Attempts at gripping a part, and at an episode that a fault of the cell cut short."""

Watch = Callable[[Cycle, Course, RunningCell], None]


@dataclass(frozen=True, slots=True)
class Schedule:
    """How many episodes with each part, in order; the learner is told of each new grip."""

    parts: tuple[tuple[str, int], ...] = (("FFC1", 48), ("FFC2", 2))

    @property
    def episodes(self) -> int:
        return sum(count for _, count in self.parts)


@dataclass(frozen=True, slots=True)
class EpisodeResult:
    """One episode: its number from 1 and part, how it ended, search steps, bench seconds.

    refused: evaluations in it that the learner would not learn from, as they were not its model's.
    """

    number: int
    part: str
    kind: Kind
    reason: str
    steps: int
    seconds: float
    refused: int = 0


@dataclass(frozen=True, slots=True)
class NearFaults:
    """What is broken on this side: the host's process, and pieces of the learner if it has any.

    first: number of the first episode.
    """

    host: HostFaults
    pieces: Pieces | None
    first: int = 1


class Attempt(NamedTuple):
    """One episode as the controller knows it: how it ended, the last sight of it, bench seconds."""

    outcome: Outcome
    seen: Observation
    seconds: float


class Trainer:
    """Drives jobs one after the other on a connected near side; `observe` goes into the loop."""

    def __init__(  # noqa: PLR0917  those of `connected`
        self,
        rig: Rig,
        near: NearSide,
        cell: RunningCell,
        watch: Watch,
        record: RunRecord | None,
        faults: NearFaults | None,
    ) -> None:
        self._faults = faults
        self._rig, self._near, self._cell = rig, near, cell
        self._watch, self._record = watch, record
        self._limits = limits(rig)
        self._course: Course | None = None
        self._loop = Loop(near.arm, near.sensor, task_frame(rig), observe=self._observe)
        self.last: Cycle | None = None

    def run(self, learner: Learner, schedule: Schedule, seed: int) -> Iterator[EpisodeResult]:
        """The whole schedule; CellError when the cell fails more often than `TRIES` in a row."""
        number = 0
        for index, (name, count) in enumerate(schedule.parts):
            plan = start_plan(self._rig, part_named(self._rig, name), seed)
            self.fetch(plan, name)
            if index:
                learner.grip_changed()
            for _ in range(count):
                number += 1
                yield self._episode(learner, plan, number, name)
            self.bring_back(plan, name)

    def fetch(self, plan: Plan, part: str) -> None:
        """Grip the part; CellError when that fails `TRIES` times."""
        self._insist(partial(fetch, plan=plan, gripper=self._near.gripper), part)

    def bring_back(self, plan: Plan, part: str) -> None:
        """Put the part back into its fixture; CellError when that fails `TRIES` times."""
        self._insist(partial(bring_back, plan=plan, gripper=self._near.gripper), part)

    def attempt(self, plan: Plan, part: str, policy: Policy) -> Attempt:
        """One episode with the part in the jaws, which are above the connector again after it."""
        begin, near = self._now, self._near
        job = partial(held_episode, plan=plan, sensor=near.sensor, gripper=near.gripper)
        outcome = self._do(partial(job, policy=policy))
        assert self.last is not None, "an episode has cycles"
        found = Attempt(outcome, observation(self.last), (self._now - begin) * 1e-9)
        self._insist(partial(leave, plan=plan), part, relaxed=True)
        return found

    def _episode(self, learner: Learner, plan: Plan, number: int, part: str) -> EpisodeResult:
        for _ in range(TRIES):
            policy = Episode(learner)
            refused, chosen = _refused(learner), self._broken(policy, number)
            outcome, seen, seconds = self.attempt(plan, part, chosen)
            policy.end(seen, outcome.kind)
            if outcome.kind in ENDINGS:
                return EpisodeResult(
                    number,
                    part,
                    outcome.kind,
                    outcome.reason,
                    policy.steps,
                    seconds,
                    _refused(learner) - refused,
                )
        raise CellError(f"episode {number}: {outcome.kind.value} {TRIES} times: {outcome.reason}")

    def _broken(self, policy: Policy, number: int) -> Policy:
        """The policy as this episode's faults leave it."""
        if self._faults is None:
            return policy
        self._faults.host.episode = self._faults.first + number - 1
        return FaultyPolicy(policy, self._faults.host, self._faults.pieces)

    def _insist(
        self, job: Callable[[Course], Phase[Ending]], part: str, *, relaxed: bool = False
    ) -> None:
        for _ in range(TRIES):
            outcome = self._do(job, relaxed=relaxed)
            if outcome.kind is Kind.DONE:
                return
        raise CellError(f"{part}: {outcome.kind.value} {TRIES} times: {outcome.reason}")

    def _do(self, job: Callable[[Course], Phase[Ending]], *, relaxed: bool = False) -> Outcome:
        bounds = self._limits.relaxed() if relaxed else self._limits
        return self._loop.run(partial(self._watched, job), bounds)

    def _watched(self, job: Callable[[Course], Phase[Ending]], course: Course) -> Phase[Ending]:
        self._course = course
        return watched(course, job(course), self._look)

    def _look(self, cycle: Cycle, course: Course) -> None:
        if self._faults is not None:
            self._faults.host.attend(cycle, course, self._cell, self._near.arm)
        self._watch(cycle, course, self._cell)

    def _observe(self, cycle: Cycle, setpoint: Place, _phase: str) -> None:
        self.last = cycle
        if self._record is not None and self._course is not None:
            self._record.cycle(cycle, setpoint, self._course)

    @property
    def _now(self) -> int:
        return self.last.t if self.last is not None else 0


def _refused(learner: Learner) -> int:
    """Evaluations that it would not learn from so far; 0 of one that asks nobody."""
    return learner.refused if isinstance(learner, Checked) else 0


def connected(  # noqa: PLR0917  faults are the seldom last
    rig: Rig,
    cell: RunningCell,
    stack: ExitStack,
    watch: Watch,
    record: RunRecord | None,
    faults: NearFaults | None = None,
) -> Trainer:
    """A trainer on a cell that is up, its drivers connected and closed with the stack."""
    tap = record.rtde if record else None
    near = stack.enter_context(near_side(rig, cell.doors, tap))
    bring_up(near.arm, near.sensor, load=load(rig))
    return Trainer(rig, near, cell, watch, record, faults)
