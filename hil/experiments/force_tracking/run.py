"""One run over the wire: cell up, drivers connected, tracked, closed; figures out."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import TypeAlias

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.loop import Loop
from controller.outcome import Ending, Kind, Outcome
from controller.place import Place
from controller.pressed import Held, pressed
from controller.start import bring_up
from controller.track import tracking
from hil.app.inline import InlineCell
from hil.app.near import limits, near_side, plan, task_frame
from hil.app.record import RunRecord, identity
from hil.app.watched import Look, watched
from hil.campaign.run import Json
from hil.cell.rig import Rig
from hil.experiments.force_tracking.figures import figures
from hil.experiments.force_tracking.trace import Trace, Tracer
from hil.experiments.force_tracking.variant import Variant, axis_of, job_of, rig_of
from hil.recording.identity import Identity
from hil.recording.recorder import Recorder

BESIDE = (4, 4, 0)
"""Steps off the slot, where a cable meets the face."""
SHOWN = 8
"""ms between two points of a kept time course."""

Row: TypeAlias = "dict[str, Json]"


def run(rig: Rig, seed: int, variant: Mapping[str, Json], text: bytes = b"") -> tuple[Row, str]:
    """One run's figures and how it ended: a function of its arguments alone.

    text: the rig file, for the recording if one is made.
    """
    what = Variant.from_json(variant)
    trace, outcome = track(rig, seed, what, text)
    made = figures(trace, what.force, completed=outcome.kind is Kind.DONE)
    row: Row = dict(made._asdict())
    if what.trace:
        row["course"] = _course(trace)
    return row, f"{outcome.kind.value}: {outcome.reason}"


def track(rig: Rig, seed: int, variant: Variant, text: bytes = b"") -> tuple[Trace, Outcome]:
    """The experiment once; raises CellError, DriverError, RecordingError, ValueError."""
    rig = rig_of(rig, variant).on_free_ports()
    axis = axis_of(variant, rig.robot.period)
    job = job_of(variant)
    tracer = Tracer(rig.tool.mass)
    with ExitStack() as stack:
        recorder = _recorder(identity_of(rig, seed, variant, text), variant, stack)
        cell = stack.enter_context(InlineCell(rig, seed, "lockstep", record=recorder is not None))
        frame = task_frame(rig)
        record = RunRecord(recorder, cell, frame, rig.robot.period) if recorder else None
        near = stack.enter_context(near_side(rig, cell.doors, record.rtde if record else None))
        bring_up(near.arm, near.sensor)
        whole = plan(rig, rig.fixture.parts[0], BESIDE) if variant.cable else None

        def perform(course: Course) -> Phase[Ending]:
            if whole is None:
                return tracking(course, axis, job)
            return pressed(course, axis, job, Held(whole, near.gripper))

        drive = _Drive(
            perform,
            lambda cycle, course: tracer.watch(cycle, course, cell),
            record,
        )
        loop = Loop(near.arm, near.sensor, frame, observe=drive.observe)
        outcome = loop.run(drive.job, limits(rig))
        if record is not None and recorder is not None:
            record.end(outcome)
            near.arm.close()
            near.sensor.close()
            cell.stop()
            record.far()
            recorder.close()
    return tracer.trace(), outcome


def identity_of(rig: Rig, seed: int, variant: Variant, text: bytes) -> Identity:
    """Of the run's recording: rig file, seed, and the variant laid over the rig."""
    settings = {key: str(value) for key, value in variant.as_json().items() if key != "recording"}
    return identity(rig.name, text, seed, settings)


def _recorder(about: Identity, variant: Variant, stack: ExitStack) -> Recorder | None:
    """An open recorder that a failing run abandons."""
    if not variant.recording:
        return None
    recorder = Recorder(Path(variant.recording), about, overwrite=True)
    recorder.open()
    stack.callback(recorder.abandon)
    return recorder


class _Drive:
    """The job with its observers, both of them in the loop's thread."""

    def __init__(
        self,
        job: Callable[[Course], Phase[Ending]],
        watch: Look,
        record: RunRecord | None,
    ) -> None:
        self._job, self._watch, self._record = job, watch, record
        self._course: Course | None = None

    def job(self, course: Course) -> Phase[Ending]:
        self._course = course
        return watched(course, self._job(course), self._watch)

    def observe(self, cycle: Cycle, setpoint: Place, _phase: str) -> None:
        if self._record is not None and self._course is not None:
            self._record.cycle(cycle, setpoint, self._course)


def _course(trace: Trace) -> dict[str, Json]:
    """Force (N) and position x_c (m) from the way down on, for a figure."""
    push = trace.push[: len(trace.push) // SHOWN * SHOWN].reshape(-1, SHOWN).mean(axis=1)
    step = max(1, SHOWN // trace.period)
    return {
        "push": [round(value, 4) for value in push.tolist()],
        "z": [round(value, 7) for value in trace.place[step - 1 :: step, 1].tolist()],
        "x": [round(value, 7) for value in trace.place[step - 1 :: step, 0].tolist()],
    }
