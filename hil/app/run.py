"""One run: cell up, drivers connected, job done, recording closed, nothing left behind."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from time import perf_counter

import orjson

from controller.action import Policy
from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.job import assembly
from controller.loop import Loop
from controller.outcome import Ending, Outcome
from controller.place import Place
from controller.settings import Plan
from controller.start import bring_up
from drivers.interfaces import SensorHealth
from hil.app.cell import CellReport, RunningCell
from hil.app.host_faults import FullDisk, HostFaults, split
from hil.app.inline import InlineCell
from hil.app.learner_faults import FaultyPolicy
from hil.app.near import NearSide, limits, load, near_side, part_named, start_plan, task_frame
from hil.app.policy import policy
from hil.app.process import CellProcess
from hil.app.real import RealCell
from hil.app.record import RunRecord, identity
from hil.app.undisturbed import undisturbed
from hil.app.watched import Look, watched
from hil.cell.faults.log import FaultEvent
from hil.cell.faults.schedule import Numbered, Schedule
from hil.cell.rig import Rig
from hil.recording.recorder import Recorder

Watch = Callable[[Cycle, Course, RunningCell], None]
"""Called in every control period, for screens and referees; must be quick and must not block.

The cell's truth stands still meanwhile in lockstep, so it belongs to the cycle.
"""


@dataclass(frozen=True, slots=True)
class Request:
    """What to run. rig_text: the rig file's bytes, attached to the recording.

    layout: `inline` or `process`, where the cell runs. clock: `lockstep` or `wall`.
    out: folder of the recording, None for none. alone: no other run shares this machine.
    faults: None is a sound run.
    """

    rig: Rig
    rig_text: bytes
    seed: int
    part: str
    policy: str = "pose"
    layout: str = "inline"
    clock: str = "lockstep"
    out: Path | None = None
    overwrite: bool = False
    alone: bool = False
    faults: Schedule | None = None

    @property
    def takes_turns(self) -> bool:
        """Whether one core serves this run best."""
        return self.alone and self.layout == "inline" and self.clock == "lockstep"


@dataclass(frozen=True, slots=True)
class Result:
    """How a run went. bench, wall: seconds of either clock in the control loop; digest: SHA-256 of
    the recording, None without one. faults: what became of them, in order.
    """

    outcome: Outcome
    bench: float
    wall: float
    health: SensorHealth
    cell: CellReport
    description: str
    digest: str | None
    faults: tuple[FaultEvent, ...] = ()

    @property
    def real_time_factor(self) -> float:
        return self.bench / self.wall if self.wall > 0 else 0.0


def open_cell(request: Request, faults: Numbered | None = None) -> RunningCell:
    """The cell of a request with its doors open, or the rig's real one; raises DoorError."""
    if request.rig.rig == "real":
        return RealCell(request.rig, request.clock)
    kind = CellProcess if request.layout == "process" else InlineCell
    record = request.out is not None
    return kind(request.rig, request.seed, request.clock, record=record, faults=faults)


def run(request: Request, watch: Watch) -> Result:
    """Pick up the part, insert it, release it; raises CellError, DriverError, RecordingError.

    What goes wrong while the arm moves is an Outcome, not an exception.
    """
    part = part_named(request.rig, request.part)
    plan = start_plan(request.rig, part, request.seed)
    with ExitStack() as stack:
        recorder = _recorder(request, stack)
        stack.enter_context(undisturbed(wanted=request.takes_turns))
        far, host = _faults(request, stack)
        cell = stack.enter_context(open_cell(request, far))
        frame, period = task_frame(request.rig), request.rig.robot.period
        sink = FullDisk(recorder, host) if recorder and host else recorder
        record = RunRecord(sink, cell, frame, period) if sink else None
        if record is not None:
            stack.callback(record.flush)
        tap = record.rtde if record else None
        near = stack.enter_context(near_side(request.rig, cell.doors, tap))
        chosen = policy(request.policy, plan, request.seed, cell)
        seen = partial(_watch, watch, cell)
        if host is not None:
            chosen = FaultyPolicy(chosen, host)
            seen = partial(_attend, host, record, near, watch, cell)
        bring_up(near.arm, near.sensor, load=load(request.rig))
        drive = _Drive(near, plan, chosen, record, seen)
        outcome = Loop(near.arm, near.sensor, frame, observe=drive.observe).run(
            drive.job, limits(request.rig)
        )
        result = _close(drive, outcome, cell, recorder)
        mine = host.events if host is not None else ()
        return replace(result, faults=tuple(sorted(result.cell.faults + mine, key=_moment)))


def _recorder(request: Request, stack: ExitStack) -> Recorder | None:
    """An open recorder that a failing run abandons; before anything moves."""
    if request.out is None:
        return None
    settings = {"policy": request.policy, "part": request.part, "clock": request.clock}
    if request.faults is not None:
        settings["faults"] = orjson.dumps(request.faults.written()).decode()
    about = identity(request.rig.name, request.rig_text, request.seed, settings)
    recorder = Recorder(request.out, about, overwrite=request.overwrite)
    recorder.open()
    stack.callback(recorder.abandon)
    return recorder


def _faults(request: Request, stack: ExitStack) -> tuple[Numbered | None, HostFaults | None]:
    """The cell's faults and those of this process; FaultError for one without a place."""
    if request.faults is None:
        return None, None
    faults = request.faults.numbered(request.seed)
    far, near = split(faults, request.rig, recorded=request.out is not None)
    period = request.rig.robot.period
    return far, stack.enter_context(HostFaults(near, request.seed, period, request.clock))


def _moment(event: FaultEvent) -> int:
    return event.t


def _attend(  # noqa: PLR0917  the last two are the loop's
    host: HostFaults,
    record: RunRecord | None,
    near: NearSide,
    watch: Watch,
    cell: RunningCell,
    cycle: Cycle,
    course: Course,
) -> None:
    """Faults of this process first, for the watcher sees what came of them."""
    host.attend(cycle, course, cell, near.arm)
    if record is not None:
        for event in host.news():
            record.fault(event)
    watch(cycle, course, cell)


def _watch(watch: Watch, cell: RunningCell, cycle: Cycle, course: Course) -> None:
    watch(cycle, course, cell)


class _Drive:
    """The job with its observers: knows the course once the loop has begun it."""

    def __init__(
        self,
        near: NearSide,
        plan: Plan,
        chosen: Policy,
        record: RunRecord | None,
        watch: Look,
    ) -> None:
        self.near, self._plan, self._policy = near, plan, chosen
        self.record, self._watch = record, watch
        self._course: Course | None = None
        self._first = self._last = 0
        self._started = self._ended = 0.0

    def job(self, course: Course) -> Phase[Ending]:
        self._course = course
        self._first, self._started = course.cycle.t, perf_counter()
        near = self.near
        job = assembly(course, self._plan, near.sensor, near.gripper, self._policy)
        return watched(course, job, self._watch)

    def observe(self, cycle: Cycle, setpoint: Place, _phase: str) -> None:
        course = self._course
        assert course is not None, "the loop begins the job before it observes"
        if self.record is not None:
            self.record.cycle(cycle, setpoint, course)
        self._last, self._ended = cycle.t, perf_counter()

    @property
    def seconds(self) -> tuple[float, float]:
        """Bench and wall seconds of the control loop."""
        return (self._last - self._first) * 1e-9, self._ended - self._started


def _close(drive: _Drive, outcome: Outcome, cell: RunningCell, recorder: Recorder | None) -> Result:
    """Close the drivers, then the cell, then the recording, which takes what the cell still has."""
    description, health = cell.description, drive.near.sensor.health
    if drive.record is not None:
        drive.record.end(outcome)
    drive.near.arm.close()
    drive.near.sensor.close()
    report = cell.stop()
    if drive.record is not None:
        drive.record.far()
    digest = recorder.close() if recorder is not None else None
    return Result(outcome, *drive.seconds, health, report, description, digest)
