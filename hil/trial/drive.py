"""The near side of a trial: brought up, driven through a job, left; each step told to a sampler."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import isfinite
from struct import Struct
from typing import Final

from controller.action import Policy
from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.job import assembly
from controller.loop import Job, Loop
from controller.outcome import Ending, Kind, Outcome
from controller.place import Place
from controller.settings import Plan
from controller.start import bring_up
from drivers.errors import DriverError
from drivers.ur.arm import UrArm
from drivers.ur.program import Command
from hil.app.near import NearSide, limits, load, task_frame
from hil.app.record import RunRecord
from hil.app.watched import watched
from hil.cell.rig import Rig
from hil.trial.sampler import Sampler

_COMMAND: Final = Struct(">4xii6dBBi")
"""An RTDE package of the recipe's inputs: command, sequence, set-point, outputs, cycle answered."""


BROKEN_OFF: Final = (Kind.DANGER, Kind.FAULT)


class Overtime(BaseException):
    """The run has used up its bench time."""


Attend = Callable[[Cycle, Course, UrArm], None]
"""Who else sees each cycle before its command: faults of this process, and the cell's own."""


def unattended(cycle: Cycle, course: Course, arm: UrArm) -> None:
    """Nobody."""


@dataclass(frozen=True, slots=True)
class Driven:
    """started: whether the near side came as far as a job. error: what it raised instead."""

    outcome: Outcome | None
    error: BaseException | None
    started: bool
    overtime: bool

    @property
    def broken_off(self) -> bool:
        """Whether the job did not come to an end of its own."""
        return self.outcome is None or self.outcome.kind in BROKEN_OFF


class Driver:
    """One near side on its way through a run."""

    def __init__(self, rig: Rig, sampler: Sampler, longest: int) -> None:
        """longest: ns of bench time after which a run counts as a hang."""
        self._rig, self._sampler, self._longest = rig, sampler, longest
        self.attend: Attend = unattended
        self.record: RunRecord | None = None
        self._course: Course | None = None
        self._began: int | None = None

    def heard(self, t: int, sent: bool, package: bytes) -> None:
        """A package that the arm's driver sent or read at arm time t, ns."""
        if self.record is not None:
            self.record.rtde(t, sent, package)
        if not sent:
            self._sampler.package()
            self._began = t if self._began is None else self._began
            if t - self._began > self._longest:
                raise Overtime
            return
        command, sequence, *pose, _, _, answered = _COMMAND.unpack_from(package)
        self._sampler.finite = all(map(isfinite, pose))
        self._sampler.command((sequence, answered), t, stopping=command != Command.SERVO)

    def run(self, near: NearSide, plan: Plan, policy: Policy) -> Driven:
        """Everything from power-up to the arm at rest; raises nothing."""
        started = False
        try:
            bring_up(near.arm, near.sensor, load=load(self._rig))
            started = True
            return Driven(self._work(near, plan, policy), None, started, overtime=False)
        except Overtime:
            return Driven(None, None, started, overtime=True)
        except DriverError as error:
            return Driven(None, error, started, overtime=False)
        except Exception as error:  # whatever escapes the near side is the verdict's to judge
            return Driven(None, error, started, overtime=False)
        finally:
            self._sampler.leaving = True
            self._leave(near)
            self._sampler.running = False

    def piece(self, near: NearSide, job: Job) -> Outcome:
        """One job, or a piece of one, by the rig's limits; raises what is not the arm's fault."""
        loop = Loop(near.arm, near.sensor, task_frame(self._rig), observe=self._observe)
        return loop.run(
            lambda course: self._sampled(course, job(course), near.arm), limits(self._rig)
        )

    def _work(self, near: NearSide, plan: Plan, policy: Policy) -> Outcome:
        job = partial(assembly, plan=plan, sensor=near.sensor, gripper=near.gripper, policy=policy)
        return self.piece(near, job)

    def _sampled(self, course: Course, job: Phase[Ending], arm: UrArm) -> Phase[Ending]:
        """The job, each cycle sampled before its command lets the cell move on.

        So are its beginning and its end: told while a command is under way, they would fall into
        the one period or the next as the threads happen to run.
        """
        self._sampler.episode, self._sampler.running = 1, True
        self._course = course

        def look(cycle: Cycle, course: Course) -> None:
            self._sampler.cycle(cycle, course)
            self.attend(cycle, course, arm)

        ending = yield from watched(course, job, look)
        self._sampler.running = False
        return ending

    def _observe(self, cycle: Cycle, setpoint: Place, _phase: str) -> None:
        if self.record is not None and self._course is not None:
            self.record.cycle(cycle, setpoint, self._course)

    def _leave(self, near: NearSide) -> None:
        self._longest = 1 << 62
        near.arm.close()
        near.sensor.close()
