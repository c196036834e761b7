"""What a run records, and when: near-side records of each cycle, far-side ones as they come."""

from collections.abc import Mapping
from contextlib import suppress
from importlib.resources import files
from typing import Protocol

from controller.course import Course
from controller.cycle import Cycle
from controller.frames import TaskFrame
from controller.outcome import Outcome
from controller.place import Place
from drivers.protocol.rtde_variables import INPUTS, OUTPUTS, Variable
from drivers.ur.sample import INPUTS as ARM_INPUTS
from drivers.ur.sample import OUTPUTS as ARM_OUTPUTS
from hil.app.cell import RunningCell
from hil.cell.faults.log import FaultEvent
from hil.recording.channel import Channel
from hil.recording.channels import control, deadline, event, wrench
from hil.recording.channels.event import EventKind
from hil.recording.channels.rtde import RecipeNames
from hil.recording.errors import RecordingError
from hil.recording.identity import Identity


def identity(name: str, text: bytes, seed: int, settings: Mapping[str, str]) -> Identity:
    """The recording's identity: rig file, seed and the choices that change a run."""
    return Identity(
        seed=seed,
        rig_name=name,
        rig=text,
        dbc=files("drivers.protocol").joinpath("nrs.dbc").read_bytes(),
        settings=settings,
        recipes_in={1: _recipe(ARM_INPUTS, INPUTS)},
        recipes_out={1: _recipe(ARM_OUTPUTS, OUTPUTS)},
    )


def _recipe(names: tuple[str, ...], table: Mapping[str, Variable]) -> RecipeNames:
    return tuple((name, table[name].type.name) for name in names)


BATCH = 32
"""Periods packed at once: code that runs once a period pays for cold caches each time (45 us a
period singly, 20 in batches)."""


class Sink(Protocol):
    """The control loop's end of a recorder."""

    def put(self, channel: Channel, t: int, payload: bytes) -> None: ...
    def settle(self, t: int) -> None: ...


class Lossy:
    """A sink whose failures the control loop never feels: what could not be taken is counted."""

    def __init__(self, sink: Sink) -> None:
        self._sink = sink
        self._lost = 0
        self._since = 0

    def put(self, channel: Channel, t: int, payload: bytes) -> None:
        try:
            self._sink.put(channel, t, payload)
        except RecordingError:
            self._since = self._since if self._lost else t
            self._lost += 1

    def settle(self, t: int) -> None:
        self._sink.settle(t)

    def mark(self, t: int) -> None:
        """Record at t, ns, what is missing, if anything is and there is room again."""
        if not self._lost:
            return
        line = f"gap: {self._lost} records from {self._since * 1e-9:.3f} s on could not be written"
        with suppress(RecordingError):
            self._sink.put(Channel.EVENT, t, event.encode(EventKind.NOTE, line))
            self._lost = 0


class RunRecord:
    """Feeds one recorder from both sides of the wire, all in the loop's thread.

    A recorder that fails leaves a gap, which is marked as soon as it works again; control goes on.
    """

    def __init__(self, recorder: Sink, cell: RunningCell, frame: TaskFrame, period: int) -> None:
        self._recorder = Lossy(recorder)
        self._cell, self._frame, self._period = cell, frame, period
        self._pending: list[tuple[Cycle, Place, str, int]] = []
        self._t: int | None = None
        self._misses = 0

    def rtde(self, t: int, sent: bool, package: bytes) -> None:
        """One RTDE package as the arm driver sent or read it at arm time t, ns."""
        self._recorder.put(Channel.RTDE_IN if sent else Channel.RTDE_OUT, t, package)

    def cycle(self, cycle: Cycle, setpoint: Place, course: Course) -> None:
        """Keep one control period; every so often, pack them and what the far side recorded."""
        self._pending.append((cycle, setpoint, course.name, course.steps))
        if len(self._pending) >= BATCH:
            self.flush()

    def flush(self) -> None:
        """Pack what is pending; the recorder then has everything up to the last cycle."""
        for cycle, setpoint, phase, step in self._pending:
            self._pack(cycle, setpoint, phase, step)
        self._pending.clear()
        self._recorder.mark(self._t or 0)
        if self._cell.live and self._t is not None:
            self.far()
            self._recorder.settle(self._t)

    def _pack(self, cycle: Cycle, setpoint: Place, phase: str, step: int) -> None:
        t, put = cycle.t, self._recorder.put
        if self._t is not None:
            self._misses += max(0, (t - self._t) // self._period - 1)
        self._t = t
        put(Channel.WRENCH, t, wrench.encode(cycle.reading))
        base = self._frame.to_base(setpoint)
        put(Channel.CTRL, t, control.encode(phase, step, base, cycle.wrench, cycle.stage))
        put(Channel.DEADLINE, t, deadline.encode(t // self._period, self._misses))

    def far(self) -> None:
        """Take over what the far side has recorded since the last call."""
        put = self._recorder.put
        for t, channel, payload in self._cell.take():
            put(channel, t, payload)

    def fault(self, found: FaultEvent) -> None:
        """A fault of this side, at the last cycle's time."""
        self._recorder.put(Channel.EVENT, self._t or 0, event.encode(EventKind.FAULT, str(found)))

    def end(self, outcome: Outcome) -> None:
        """How it ended, at the last cycle's time."""
        self.flush()
        kind = EventKind.OUTCOME if outcome.standstill is None else EventKind.GUARD
        line = f"{outcome.kind.value}: {outcome.reason}"
        self._recorder.put(Channel.EVENT, self._t or 0, event.encode(kind, line))
