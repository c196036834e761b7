"""Runs a case: part gripped, pressed on the face or held above it, for so many bench seconds."""

import gc
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, thread_time_ns

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.force_axis import ForceAxis
from controller.job import fetch
from controller.loop import Loop
from controller.outcome import Ending, Kind
from controller.phases.approach import approach
from controller.phases.contact import contact
from controller.place import Place
from controller.settings import Plan
from controller.start import bring_up
from hil.app.inline import InlineCell
from hil.app.near import NearSide, limits, near_side, plan, task_frame
from hil.app.record import RunRecord, identity
from hil.app.undisturbed import undisturbed
from hil.bench.case import Case
from hil.bench.meter import Meter
from hil.cell.clock import Lateness
from hil.cell.errors import CellError
from hil.cell.rig import Rig
from hil.recording.recorder import Recorder

START = (4, 4, 0)
"""Steps off the slot: on the face, with all of the cable's edge."""


@dataclass(frozen=True, slots=True)
class Measured:
    """One case's figures. parts: CPU microseconds of one period; lateness: wall clock only."""

    case: Case
    real_time_factor: float
    periods: int
    parts: dict[str, float]
    lateness: Lateness | None

    def figures(self) -> dict[str, object]:
        """As a program reads them."""
        return {
            "real_time_factor": self.real_time_factor,
            "periods": self.periods,
            "parts": self.parts,
            "lateness_ns": None if self.lateness is None else self.lateness._asdict(),
        }


def measure(rig: Rig, rig_text: bytes, case: Case, seconds: float) -> Measured:
    """The case twice: once as it is, once with its parts metered. Recording is on."""
    plain = _Bench(case.rig(rig), rig_text, case, seconds)
    plain.perform()
    parts: dict[str, float] = {}
    if case.clock == "lockstep":
        metered = _Bench(case.rig(rig), rig_text, case, min(seconds, 5.0), Meter())
        metered.perform()
        parts = metered.parts()
    return Measured(case, plain.real_time_factor, plain.periods, parts, plain.lateness)


def speed(rig: Rig, rig_text: bytes, case: Case, seconds: float) -> float:
    """How many times real time the case runs, nothing metered."""
    plain = _Bench(case.rig(rig), rig_text, case, seconds)
    plain.perform()
    return plain.real_time_factor


class _Bench:
    """One cell, one pair of drivers, one timed stretch of control periods."""

    def __init__(
        self, rig: Rig, text: bytes, case: Case, seconds: float, meter: Meter | None = None
    ) -> None:
        self._rig, self._text, self._case, self._seconds = rig, text, case, seconds
        self._meter = meter
        self._course: Course | None = None
        self._record: RunRecord | None = None
        self._wall = self._bench = 0.0
        self._near_cpu = 0
        self.periods = 0
        self.lateness: Lateness | None = None

    @property
    def real_time_factor(self) -> float:
        return self._bench / self._wall

    def parts(self) -> dict[str, float]:
        """CPU microseconds a period; control is the rest of the near side's thread."""
        assert self._meter is not None
        spent = dict(self._meter.spent)
        near = sum(spent.pop(part) for part in list(spent) if part.startswith("near "))
        measured = self._meter.spent
        named = {
            "physics": spent.get("physics", 0),
            "sensor": spent.get("sensor", 0),
            "can": spent.get("can", 0) + measured.get("near can", 0),
            "arm": spent.get("arm", 0),
            "rtde": spent.get("rtde", 0) + measured.get("near rtde", 0),
            "recording": spent.get("recording", 0) + measured.get("near recording", 0),
            "control": max(0, self._near_cpu - near),
        }
        return {part: ns / self.periods * 1e-3 for part, ns in named.items()}

    def perform(self) -> None:
        with ExitStack() as stack:
            folder = Path(stack.enter_context(TemporaryDirectory()))
            recorder = Recorder(folder / "run", identity(self._rig.name, self._text, 1, {}))
            recorder.open()
            stack.callback(recorder.abandon)
            stack.enter_context(undisturbed(wanted=self._case.clock == "lockstep"))
            cell = InlineCell(self._rig, 1, self._rig.clock)
            stack.enter_context(cell)
            record = RunRecord(recorder, cell, task_frame(self._rig), self._rig.robot.period)
            self._record = record
            near = stack.enter_context(near_side(self._rig, cell.doors, record.rtde))
            if self._meter is not None:
                self._instrument(self._meter, cell, near, record)
            self._drive(near)
            self.lateness = cell.stop().lateness

    def _instrument(
        self, meter: Meter, cell: InlineCell, near: NearSide, record: RunRecord
    ) -> None:
        served = cell.served
        bench = served.bench
        meter.wrap("physics", bench.plant, "step")
        meter.stand_in("arm", bench, "arm", "frame", "observe")
        meter.wrap("sensor", bench.node, "advance")
        meter.wrap("can", served.gateway, "send", "receive")
        meter.wrap("rtde", served.server, "poll", "publish", "flush")
        meter.wrap("near rtde", near.arm, "read", "servo")
        meter.wrap("near can", near.sensor, "read")
        meter.wrap("near recording", record, "cycle")

    def _drive(self, near: NearSide) -> None:
        bring_up(near.arm, near.sensor)
        rig = self._rig
        whole = plan(rig, rig.fixture.parts[0], START)
        loop = Loop(near.arm, near.sensor, task_frame(rig), observe=self._observe)
        bounds = limits(rig)
        if self._case.clock == "wall":
            bounds = bounds.relaxed()  # lateness is measured; a late command's jerk is no verdict
        outcome = loop.run(lambda course: self._job(course, whole, near), bounds)
        if outcome.kind is not Kind.DONE:
            raise CellError(f"{self._case.name}: {outcome.kind.value}: {outcome.reason}")

    def _job(self, course: Course, whole: Plan, near: NearSide) -> Phase[Ending]:
        self._course = course
        yield from fetch(course, whole, near.gripper)
        yield from approach(course, whole.start, whole.travel)
        axis = ForceAxis(whole.press, course.period)
        if self._case.contact:
            yield from contact(course, axis, whole)
        gc.collect()
        yield from self._timed(course, axis)
        return Ending(Kind.DONE, "measured")

    def _timed(self, course: Course, axis: ForceAxis) -> Phase[None]:
        """The stretch that counts."""
        self.periods = max(1, round(self._seconds / course.period))
        if self._meter is not None:
            self._meter.on = True
        t, wall, cpu = course.cycle.t, perf_counter(), thread_time_ns()
        for _ in range(self.periods):
            place = axis.follow(course) if self._case.contact else course.setpoint
            yield from course.to(place)
        self._wall, self._near_cpu = perf_counter() - wall, thread_time_ns() - cpu
        self._bench = (course.cycle.t - t) * 1e-9
        if self._meter is not None:
            self._meter.on = False

    def _observe(self, cycle: Cycle, setpoint: Place, _phase: str) -> None:
        if self._record is not None and self._course is not None:
            self._record.cycle(cycle, setpoint, self._course)
